#include "services/calibration/files/whole_file.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace arcstart::calibration {

namespace fs = std::filesystem;

void write_whole(const std::string& path, const std::string& text) {
  const std::string part = path + ".part";
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(part, path, error);
  if (file && !error) return;
  fs::remove(part, error);
  throw CalibrationSetError(path + ": cannot be written: is its folder there, is the disk full?");
}

void replace_calibration_file(const std::string& path, const std::string& text) {
  std::error_code missing;
  if (fs::is_regular_file(path, missing)) {
    std::ostringstream there;
    there << std::ifstream(path, std::ios::binary).rdbuf();
    if (there.str() != text)
      write_whole(fs::path(path).replace_extension(".former.yaml").string(), there.str());
  }
  write_whole(path, text);
}

}  // namespace arcstart::calibration
