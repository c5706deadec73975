#include <set>

#include "tests/house/house_rules.hpp"
#include "tests/house/room_list.hpp"
#include "tests/house/source_tree.hpp"

namespace arcstart::test {
namespace {

// What is wrong with an include of `target` by a file at `from`; empty if nothing.
std::string fault(const RoomList& list, const RoomList::Place& from, const std::string& target) {
  if (target.starts_with("tests/")) return "only tests may use tests";
  const RoomList::Place to = list.place_of(target);
  if (to.service.empty()) return "";  // a library's, or generated
  if (from.service == to.service) {
    if (from.room < 0 || to.room < 0 || to.room >= from.room) return "";
    return list.room_name(from) + " lies below " + list.room_name(to);
  }
  if (from.service == "common") return "common uses no service";
  if (to.service == "common")
    return list.may_use_common(from.service, target) ? "" : from.service + " may not use it";
  if (!list.may_use(from.service, to.service))
    return from.service + " does not lie above " + to.service;
  if (target.ends_with("_app.hpp") && from.service != "command_line")
    return "it is another service's app";
  return "";
}

}  // namespace

std::vector<std::string> wrong_includes(const std::filesystem::path& root) {
  const RoomList list(root);
  std::vector<std::string> lines;
  std::set<std::pair<std::string, int>> lived_in;
  std::set<std::string> strange;  // folders, each reported once
  for (const SourceFile& file : sources_below(root, {"common", "services"})) {
    const RoomList::Place place = list.place_of(file.path);
    lived_in.emplace(place.service, place.room);
    if (place.room < 0 && strange.insert(folder_of(file.path)).second)
      lines.push_back(file.path + ": services/rooms.txt does not list its room");
    for (const Include& include : file.includes)
      if (const std::string why = fault(list, place, include.target); !why.empty())
        lines.push_back(file.path + ":" + std::to_string(include.line) + ": includes \"" +
                        include.target + "\": " + why);
  }
  for (const auto& [service, rooms] : list.rooms())
    for (int room = 0; room < static_cast<int>(rooms.size()); ++room)
      if (!lived_in.contains({service, room}))
        lines.push_back("services/rooms.txt: " + service + ": " +
                        rooms[static_cast<std::size_t>(room)] + " holds no file");
  return lines;
}

}  // namespace arcstart::test
