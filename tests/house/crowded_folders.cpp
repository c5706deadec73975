#include <map>

#include "tests/house/house_rules.hpp"
#include "tests/house/source_tree.hpp"

namespace arcstart::test {
namespace {

constexpr int kMostFiles = 24;  // sources in a folder; the architecture's rule

}  // namespace

std::vector<std::string> crowded_folders(const std::filesystem::path& root) {
  std::map<std::string, int> counts;
  for (const SourceFile& file : sources_below(root, {"common", "services", "tests"}))
    ++counts[folder_of(file.path)];
  std::vector<std::string> lines;
  for (const auto& [folder, count] : counts)
    if (count > kMostFiles)
      lines.push_back(folder + ": holds " + std::to_string(count) + " source files, more than " +
                      std::to_string(kMostFiles));
  return lines;
}

}  // namespace arcstart::test
