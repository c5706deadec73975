#include "services/calibration/files/calibration_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>

#include "services/calibration/files/target_file.hpp"
#include "services/extraction/files/image_file.hpp"

namespace arcstart::calibration {
namespace {

namespace fs = std::filesystem;

// The images of a folder, NNNN.png and the like, by their number.
std::map<int, std::string> images_in(const fs::path& folder) {
  std::map<int, std::string> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (!extraction::is_image_name(path.string())) continue;
    const std::string stem = path.stem().string();
    int index = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), index);
    if (error != std::errc{} || end != stem.data() + stem.size() || index < 0)
      throw CalibrationSetError(path.string() + ": is not named after its pose, as in 0007.png");
    if (!images.emplace(index, path.string()).second)
      throw CalibrationSetError(
          fmt::format("{}: two images have the number {}", path.string(), index));
  }
  if (images.empty())
    throw CalibrationSetError(folder.string() +
                              ": holds no images NNNN.png, .jpg, .jpeg, .bmp, .tif or .tiff");
  return images;
}

template <class Values, class Others>
void require_all(const Values& values, const Others& others, const std::string& message) {
  for (const auto& [index, value] : values)
    if (!others.contains(index))
      throw CalibrationSetError(fmt::format(fmt::runtime(message), index));
}

}  // namespace

CalibrationSet read_calibration_set(const std::string& folder) {
  const fs::path root(folder);
  if (!fs::is_directory(root))
    throw CalibrationSetError(
        folder + ": is no folder: give one with plate.yaml, poses.csv, grid/ and laser/");
  CalibrationSet set;
  set.plate = read_target_file((root / "plate.yaml").string());
  const auto poses = read_poses_file((root / "poses.csv").string());
  if (!fs::is_directory(root / "grid"))
    throw CalibrationSetError((root / "grid").string() +
                              ": is missing: it holds the images of the plate, NNNN.png");
  const auto grids = images_in(root / "grid");
  const bool two_images = fs::is_directory(root / "laser");
  const auto lasers = two_images ? images_in(root / "laser") : grids;

  require_all(poses, grids, folder + ": pose {0} of poses.csv has no image grid/{0:04}.png");
  require_all(grids, poses, folder + ": image grid/{0:04}.png has no pose {0} in poses.csv");
  require_all(grids, lasers, folder + ": pose {0} has no image laser/{0:04}.png");
  require_all(lasers, grids, folder + ": image laser/{0:04}.png has no grid/{0:04}.png");
  for (const auto& [index, pose] : poses)
    set.poses.push_back({index, grids.at(index), lasers.at(index), pose});
  return set;
}

}  // namespace arcstart::calibration
