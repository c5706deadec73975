#include "services/command_line/imports/csv_table.hpp"

#include <fmt/core.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>

#include "common/bus/value_checks.hpp"
#include "services/command_line/imports/import_error.hpp"

namespace arcstart::command_line {
namespace {

std::string trimmed(const std::string& text) {
  const char* const kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(',', begin);
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string::npos) return fields;
    begin = end + 1;
  }
}

// A header names its columns; nan and inf are numbers, if bad ones.
bool is_header(const CsvRow& row) {
  const std::string& first = row.fields.front();
  return !first.empty() && std::isalpha(static_cast<unsigned char>(first.front())) != 0 &&
         first != "nan" && first != "inf";
}

// The rest of the text must be empty.
template <class Number>
bool parse(const std::string& text, Number& value) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

std::string CsvTable::where(const CsvRow& row) const {
  return fmt::format("{}:{}", path, row.line);
}

CsvTable read_csv(const std::string& path, const std::string& what_it_holds) {
  std::ifstream file(path);
  std::string line;
  CsvTable table;
  table.path = path;
  // A folder opens, but does not read.
  if (!file || (file.peek() == std::ifstream::traits_type::eof() && !file.eof()))
    throw ImportError(
        fmt::format("{}: is missing or cannot be read: it holds {}", path, what_it_holds));
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // a byte order mark
    const std::string text = trimmed(line);
    if (text.empty() || text.starts_with('#')) continue;
    CsvRow row{number, split(text)};
    if (row.fields.size() == 1 && text.find_first_of("; \t") != std::string::npos)
      throw ImportError(
          fmt::format("{}:{}: holds no comma: separate the columns by commas", path, number));
    if (table.rows.empty() && table.header.fields.empty() && is_header(row))
      table.header = std::move(row);
    else
      table.rows.push_back(std::move(row));
  }
  if (table.rows.empty())
    throw ImportError(fmt::format("{}: holds no row of {}", path, what_it_holds));
  return table;
}

void require_fields(const CsvTable& table, const CsvRow& row, std::size_t count,
                    const std::string& columns) {
  if (row.fields.size() != count)
    throw ImportError(fmt::format("{}: {} columns, not {}: give {}", table.where(row),
                                  row.fields.size(), count, columns));
}

double number_at(const CsvTable& table, const CsvRow& row, std::size_t column) {
  double value = 0;
  if (!parse(row.fields[column], value) || !std::isfinite(value))
    throw ImportError(fmt::format("{}: column {}: '{}' is no finite number", table.where(row),
                                  column + 1, row.fields[column]));
  return value;
}

std::int64_t utime_at(const CsvTable& table, const CsvRow& row, std::size_t column) {
  constexpr std::int64_t kEarliest = 1'000'000'000'000'000;  // us: September 2001
  const std::string& text = row.fields[column];
  std::int64_t utime = 0;
  if (parse(text, utime) && utime >= kEarliest && is_time(utime)) return utime;
  // What would be after 2001 and before 2128 in that unit.
  double value = 0;
  const auto would_be = [&](double ticks_per_s) {
    return parse(text, value) && value >= 1e9 * ticks_per_s && value < 5e9 * ticks_per_s;
  };
  const char* const unit = would_be(1)     ? ": it looks like s"
                           : would_be(1e3) ? ": it looks like ms"
                           : would_be(1e9) ? ": it looks like ns"
                                           : "";
  throw ImportError(
      fmt::format("{}: '{}' is no time in us since 1970 (UTC), a whole number of 16 digits{}: give "
                  "frames.csv and poses.csv in us of one clock",
                  table.where(row), text, unit));
}

}  // namespace arcstart::command_line
