// services/rooms.txt: which part of the code may include which.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace arcstart::test {

// One line: what is wrong with services/rooms.txt.
class RoomListError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RoomList {
 public:
  // Reads services/rooms.txt below the root; its own comment describes the format. Throws
  // RoomListError.
  explicit RoomList(const std::filesystem::path& root);

  struct Place {
    std::string service;  // or common; empty for what is neither
    int room;             // its index from the top; -1: in no room of the list
  };
  // Where a file lies; the path is below the root.
  Place place_of(const std::string& path) const;

  bool knows(const std::string& service) const { return rooms_.contains(service); }
  const std::string& room_name(const Place& place) const;
  // Each room of each service, by service.
  const std::map<std::string, std::vector<std::string>>& rooms() const { return rooms_; }

  // Whether code of the first service may include code of the second.
  bool may_use(const std::string& user, const std::string& used) const;
  // Whether the service may include this header of common/.
  bool may_use_common(const std::string& service, const std::string& header) const;

 private:
  void take(const std::string& name, const std::vector<std::string>& words);

  std::vector<std::string> order_;                           // of services, from the top down
  std::map<std::string, std::vector<std::string>> rooms_;    // by service, from the top down
  std::map<std::string, std::vector<std::string>> commons_;  // all that a service may use of common
};

}  // namespace arcstart::test
