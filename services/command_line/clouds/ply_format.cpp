#include <fmt/core.h>

#include "services/command_line/clouds/point_cloud_table.hpp"

namespace arcstart::command_line {
namespace {

PointField ply_field(const std::vector<std::string_view>& words, const std::string& name) {
  struct Type {
    const char* name;
    const char* sized_name;
    FieldKind kind;
    std::size_t size;
  };
  static constexpr Type kTypes[] = {
      {"char", "int8", FieldKind::kSigned, 1},    {"uchar", "uint8", FieldKind::kUnsigned, 1},
      {"short", "int16", FieldKind::kSigned, 2},  {"ushort", "uint16", FieldKind::kUnsigned, 2},
      {"int", "int32", FieldKind::kSigned, 4},    {"uint", "uint32", FieldKind::kUnsigned, 4},
      {"float", "float32", FieldKind::kFloat, 4}, {"double", "float64", FieldKind::kFloat, 8},
  };
  if (words.size() == 3)
    for (const Type& type : kTypes)
      if (words[1] == type.name || words[1] == type.sized_name)
        return {std::string(words[2]), type.kind, type.size, 1};
  fail_to_read(name, "its header has a property of unknown type");
}

}  // namespace

PointCloud parse_ply(std::string_view bytes, const std::string& name) {
  PointCloud cloud;
  PointTable table;
  HeaderText text(bytes, name);
  std::string format;
  enum { kBefore, kVertex, kAfter } part = kBefore;
  text.line();
  for (;;) {
    const auto words = words_of(text.line());
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      format = words.size() == 3 ? std::string(words[1]) : "nothing";
    } else if (words[0] == "element") {
      if (words.size() != 3) fail_to_read(name, "its header has an element without name or count");
      const std::size_t count = count_of(words[2], name, "element");
      if (words[1] == "vertex" && part == kBefore) {
        part = kVertex;
        table.points = count;
      } else if (part == kBefore && count > 0) {
        fail_to_read(name, fmt::format("its first element is '{:.40}', must be vertex", words[1]));
      } else if (part == kVertex) {
        part = kAfter;
      }
    } else if (words[0] == "property") {
      if (part != kVertex) continue;
      if (words.size() > 1 && words[1] == "list")
        fail_to_read(name, "its vertices hold lists, which no point cloud does");
      if (table.fields.size() >= kMostFields)
        fail_to_read(name, "its header names too many properties");
      table.fields.push_back(ply_field(words, name));
    } else {
      fail_to_read(
          name, fmt::format("its header has a line '{:.40}', which PLY does not know", words[0]));
    }
  }
  if (part == kBefore) fail_to_read(name, "its header has no element vertex");
  table.big_endian = format == "binary_big_endian";
  if (format == "binary_little_endian" || table.big_endian) {
    read_binary_table(cloud, table, text.left(), name);
  } else if (format == "ascii") {
    read_ascii_table(cloud, table, text, name);
  } else {
    fail_to_read(name, fmt::format("its format is '{:.40}', must be ascii, binary_little_endian or "
                                   "binary_big_endian",
                                   format));
  }
  return cloud;
}

}  // namespace arcstart::command_line
