#include "services/cell_simulator/scene/stl.hpp"

#include <fmt/core.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

namespace arcstart::cell_simulator {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;
// Beyond 1 km no work is meant, and the squares of an intersection would lose their digits.
constexpr float farthest = 1e6f;

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

void add_corner(TriangleMesh& mesh, float x, float y, float z, const std::string& where) {
  for (const float value : {x, y, z})
    if (!(std::abs(value) <= farthest))
      throw StlError(
          fmt::format("{}: a corner that is not finite or beyond {} units", where, farthest));
  mesh.corners.emplace_back(x, y, z);
}

TriangleMesh parse_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < header_bytes)
    throw StlError(fmt::format("{}: {} bytes are too few for an STL file", name, bytes.size()));
  const std::uint64_t announced = number_at<std::uint32_t>(bytes, header_bytes - 4);
  const std::uint64_t there = (bytes.size() - header_bytes) / triangle_bytes;
  if (there < announced)
    throw StlError(fmt::format("{}: cut off or not STL: {} triangles announced, {} there", name,
                               announced, there));
  TriangleMesh mesh;
  for (std::uint64_t i = 0; i < announced; ++i) {
    const std::size_t at = header_bytes + i * triangle_bytes + 12;  // past the normal
    for (std::size_t corner = at; corner < at + 36; corner += 12)
      add_corner(mesh, number_at<float>(bytes, corner), number_at<float>(bytes, corner + 4),
                 number_at<float>(bytes, corner + 8), fmt::format("{}: triangle {}", name, i + 1));
    const int first = static_cast<int>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Words between blanks, with the line they stand in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  int line() const { return line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

TriangleMesh parse_text(std::string_view bytes, const std::string& name) {
  Words words(bytes);
  TriangleMesh mesh;
  const auto where = [&] { return fmt::format("{}:{}", name, words.line()); };
  const auto fail = [&](std::string_view wanted, std::string_view word) {
    const std::string found =
        word.empty() ? "the end of the file" : fmt::format("'{}'", word.substr(0, 30));
    throw StlError(fmt::format("{}: expected '{}', found {}", where(), wanted, found));
  };
  const auto expect = [&](std::string_view wanted) {
    if (const std::string_view word = words.next(); word != wanted) fail(wanted, word);
  };
  const auto number = [&] {
    std::string_view word = words.next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;  // read as double, so that a number too small for a float is 0 and no error
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      throw StlError(fmt::format("{}: expected a number, found '{}'", where(), word.substr(0, 30)));
    return static_cast<float>(value);
  };
  expect("solid");
  words.skip_line();  // the solid's name
  for (;;) {
    const std::string_view word = words.next();
    if (word == "endsolid") break;
    if (word != "facet") fail("facet' or 'endsolid", word);
    expect("normal");
    for (int i = 0; i < 3; ++i) number();
    expect("outer");
    expect("loop");
    const int first = static_cast<int>(mesh.corners.size());
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      const float x = number(), y = number(), z = number();
      add_corner(mesh, x, y, z, where());
    }
    expect("endloop");
    expect("endfacet");
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Binary files may begin with "solid" too: what announces as many triangles as fill the file is
// binary.
bool is_text(std::string_view bytes) {
  if (!bytes.starts_with("solid")) return false;
  if (bytes.size() < header_bytes) return true;
  const std::uint64_t announced = number_at<std::uint32_t>(bytes, header_bytes - 4);
  return header_bytes + announced * triangle_bytes != bytes.size();
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, const std::string& name) {
  TriangleMesh mesh = is_text(bytes) ? parse_text(bytes, name) : parse_binary(bytes, name);
  if (mesh.triangles.empty()) throw StlError(name + ": holds no triangle");
  return mesh;
}

TriangleMesh read_stl(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw StlError(path + ": cannot be opened");
  std::string bytes;
  try {
    bytes.assign(std::istreambuf_iterator<char>(file), {});
  } catch (const std::ios_base::failure&) {  // a folder, for one
    throw StlError(path + ": cannot be read");
  }
  return parse_stl(bytes, path);
}

}  // namespace arcstart::cell_simulator
