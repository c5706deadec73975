#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "services/command_line/clouds/point_cloud_table.hpp"

namespace arcstart::command_line {
namespace {

constexpr std::size_t kLooked = 65536;  // bytes in which the first point must begin

bool separates(char c) { return HeaderText::space(c) || c == ',' || c == ';'; }

// The words of a line, whatever separates them.
void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t i = 0; i < line.size();) {
    std::size_t end = i;
    while (end < line.size() && !separates(line[end])) ++end;
    if (end > i) words.push_back(line.substr(i, end - i));
    i = end + 1;
  }
}

std::string_view take_line(std::string_view& bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const std::string_view line = bytes.substr(0, end);
  bytes.remove_prefix(std::min(end + 1, bytes.size()));
  return line;
}

bool is_comment(std::string_view line) {
  return line.substr(0, 1) == "#" || line.substr(0, 2) == "//";
}

using TextColumns = std::array<std::size_t, 3>;  // of x, y and z

// Where a line names x, y and z: "x,y,z,intensity", "//X Y Z".
std::optional<TextColumns> named_columns(std::string_view line) {
  while (!line.empty() && (line.front() == '#' || line.front() == '/')) line.remove_prefix(1);
  std::vector<std::string_view> words;
  split(line, words);
  TextColumns columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find_if(words.begin(), words.end(), [&](std::string_view word) {
      if (word.size() > 1 && word.front() == '"' && word.back() == '"')
        word = word.substr(1, word.size() - 2);
      return word.size() == 1 && std::tolower(static_cast<unsigned char>(word[0])) == "xyz"[axis];
    });
    if (found == words.end()) return std::nullopt;
    columns[axis] = static_cast<std::size_t>(found - words.begin());
  }
  return columns;
}

bool all_numbers(const std::vector<std::string_view>& words) {
  return std::all_of(words.begin(), words.end(), [](auto word) { return number_of(word); });
}

}  // namespace

// By the first line that is neither empty nor a comment; PCD's begins with a word of its own.
bool is_text_table(std::string_view bytes) {
  bytes = bytes.substr(0, kLooked);
  std::vector<std::string_view> words;
  while (!bytes.empty()) {
    const std::string_view line = take_line(bytes);
    split(line, words);
    if (words.empty() || is_comment(line)) continue;
    return all_numbers(words) || named_columns(line);
  }
  return false;
}

PointCloud parse_text_table(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  TextColumns columns = {0, 1, 2};
  std::vector<std::string_view> words;
  std::size_t columns_before = 0;
  for (int number = 1; !bytes.empty(); ++number) {
    const std::string_view line = take_line(bytes);
    const auto fail = [&](const std::string& why) {
      fail_to_read(name, fmt::format("line {}: {}", number, why));
    };
    if (columns_before == 0)
      if (const auto named = named_columns(line)) {
        columns = *named;
        continue;
      }
    split(line, words);
    if (words.empty() || is_comment(line)) continue;
    // PTS: how many follow. What is there counts.
    if (columns_before == 0 && words.size() == 1 && all_numbers(words)) continue;
    // "1,5;2,5;3,5" would be read as six columns.
    if (line.find(';') != std::string_view::npos && line.find(',') != std::string_view::npos)
      fail("commas and semicolons: numbers with a decimal comma are not read, write 1.5 for 1,5");
    if (columns_before == 0) columns_before = words.size();
    if (words.size() <= *std::max_element(columns.begin(), columns.end()))
      fail(fmt::format("{} columns, too few for x, y and z", words.size()));
    if (words.size() != columns_before)
      fail(fmt::format("{} columns, the lines before have {}", words.size(), columns_before));
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = number_of(words[columns[axis]]);
      if (!value) fail(fmt::format("'{:.40}' is no number", words[columns[axis]]));
      point[static_cast<Eigen::Index>(axis)] = *value;
    }
    take_point(cloud, point);
  }
  return cloud;
}

}  // namespace arcstart::command_line
