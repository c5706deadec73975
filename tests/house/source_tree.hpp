// The sources of a checkout, and what each includes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace arcstart::test {

struct Include {
  int line;            // in the file that includes, 1 for the first
  std::string target;  // as the file would be named below the root
};

struct SourceFile {
  std::string path;               // below the root: services/seam_finding/main.cpp
  std::vector<Include> includes;  // those in quotes, in order
};

// All .cpp and .hpp of these folders of the root, by path. A folder that is not there holds none.
std::vector<SourceFile> sources_below(const std::filesystem::path& root,
                                      const std::vector<std::string>& folders);

// services/seam_finding of services/seam_finding/main.cpp.
std::string folder_of(const std::string& path);

}  // namespace arcstart::test
