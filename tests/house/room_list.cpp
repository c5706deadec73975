#include "tests/house/room_list.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/house/source_tree.hpp"

namespace arcstart::test {
namespace {

constexpr const char* kOrder = "order";
constexpr const char* kCommonUse = " uses of common";

int index_of(const std::vector<std::string>& list, const std::string& name) {
  const auto found = std::find(list.begin(), list.end(), name);
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

bool is_pattern(const std::string& room) { return room.find('*') != std::string::npos; }

}  // namespace

RoomList::RoomList(const std::filesystem::path& root) {
  std::ifstream file(root / "services/rooms.txt");
  if (!file) throw RoomListError("services/rooms.txt: is missing");
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    const std::size_t colon = line.find(':');
    std::istringstream text(colon == std::string::npos ? "" : line.substr(colon + 1));
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty())
      throw RoomListError("services/rooms.txt:" + std::to_string(number) +
                          ": is not of the form `name: word word ...`");
    take(line.substr(0, colon), words);
  }
  if (order_.empty()) throw RoomListError("services/rooms.txt: lacks the services' order");
}

void RoomList::take(const std::string& name, const std::vector<std::string>& words) {
  const std::size_t uses = name.find(kCommonUse);
  if (name == kOrder)
    order_ = words;
  else if (uses != std::string::npos)
    commons_[name.substr(0, uses)] = words;
  else if (!rooms_.emplace(name, words).second)
    throw RoomListError("services/rooms.txt: " + name + " stands there twice");
}

RoomList::Place RoomList::place_of(const std::string& path) const {
  std::string service, home = "common";
  if (path.starts_with("common/")) {
    service = home;
  } else if (path.starts_with("services/")) {
    const std::size_t end = path.find('/', std::string("services/").size());
    if (end == std::string::npos) return {"", -1};
    home = path.substr(0, end);
    service = home.substr(home.find('/') + 1);
  } else {
    return {"", -1};
  }
  const auto found = rooms_.find(service);
  if (found == rooms_.end()) return {service, -1};
  const std::string inside = path.substr(home.size() + 1);
  if (inside.find('/') != std::string::npos) {
    // The innermost folder that is listed.
    for (std::string folder = folder_of(inside); !folder.empty(); folder = folder_of(folder))
      if (const int room = index_of(found->second, folder); room >= 0) return {service, room};
    return {service, -1};
  }
  for (std::size_t room = 0; room < found->second.size(); ++room)
    if (is_pattern(found->second[room]) &&
        fnmatch(found->second[room].c_str(), inside.c_str(), 0) == 0)
      return {service, static_cast<int>(room)};
  return {service, index_of(found->second, ".")};
}

const std::string& RoomList::room_name(const Place& place) const {
  return rooms_.at(place.service).at(static_cast<std::size_t>(place.room));
}

bool RoomList::may_use(const std::string& user, const std::string& used) const {
  if (user == used || used == "common") return true;
  const int from = index_of(order_, user), to = index_of(order_, used);
  return from >= 0 && to > from;
}

bool RoomList::may_use_common(const std::string& service, const std::string& header) const {
  const auto found = commons_.find(service);
  if (found == commons_.end()) return true;
  return index_of(found->second, std::filesystem::path(header).stem().string()) >= 0;
}

}  // namespace arcstart::test
