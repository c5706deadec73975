// The rules of the house. Each function gives a line for each place where its rule is broken.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace arcstart::test {

// Includes run down through the rooms of services/rooms.txt and never up, from service to service
// in their order and never to another's app (but for command_line's), never from common/ to a
// service nor from either to tests/; and every file lies in a room, every room holds files. Throws
// RoomListError.
std::vector<std::string> wrong_includes(const std::filesystem::path& root);

// Components (a header with its .cpp of the same name) that include each other in a circle.
std::vector<std::string> circles(const std::filesystem::path& root);

// Folders below services/, common/ and tests/ with more source files than one looks through.
std::vector<std::string> crowded_folders(const std::filesystem::path& root);

}  // namespace arcstart::test
