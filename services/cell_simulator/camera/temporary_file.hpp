// A file that lives as long as the object.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace arcstart::cell_simulator {

class TemporaryFile {
 public:
  // Throws std::runtime_error where the folder for temporary files ($TMPDIR, else /tmp) takes none.
  TemporaryFile(const std::string& prefix, std::string_view content)
      : path_((std::filesystem::temp_directory_path() / (prefix + "XXXXXX")).string()) {
    const int file = mkstemp(path_.data());
    if (file < 0)
      throw std::runtime_error(path_ +
                               ": cannot be made: set TMPDIR to a folder that can be written");
    const bool whole =
        write(file, content.data(), content.size()) == static_cast<ssize_t>(content.size());
    close(file);
    if (whole) return;
    unlink(path_.c_str());
    throw std::runtime_error(path_ + ": cannot be written: is the disk full?");
  }
  ~TemporaryFile() { unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace arcstart::cell_simulator
