#include "tests/house/source_tree.hpp"

#include <algorithm>
#include <fstream>
#include <regex>

namespace arcstart::test {
namespace fs = std::filesystem;
namespace {

std::vector<Include> includes_of(const fs::path& root, const std::string& path) {
  static const std::regex pattern(R"re(\s*#\s*include\s*"([^"]+)".*)re");
  std::vector<Include> includes;
  std::ifstream file(root / path);
  int number = 0;
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (!std::regex_match(line, match, pattern)) continue;
    // The compiler looks beside the file first.
    const std::string beside = folder_of(path) + "/" + match[1].str();
    const bool is_beside = fs::exists(root / beside);
    const fs::path target = is_beside ? fs::path(beside) : fs::path(match[1].str());
    includes.push_back({number, target.lexically_normal().string()});
  }
  return includes;
}

}  // namespace

std::string folder_of(const std::string& path) { return fs::path(path).parent_path().string(); }

std::vector<SourceFile> sources_below(const fs::path& root,
                                      const std::vector<std::string>& folders) {
  std::vector<SourceFile> sources;
  for (const std::string& folder : folders) {
    if (!fs::is_directory(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (!entry.is_regular_file() || (extension != ".cpp" && extension != ".hpp")) continue;
      const std::string path = fs::relative(entry.path(), root).string();
      sources.push_back({path, includes_of(root, path)});
    }
  }
  std::sort(sources.begin(), sources.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return sources;
}

}  // namespace arcstart::test
