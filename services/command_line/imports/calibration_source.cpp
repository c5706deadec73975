#include "services/command_line/imports/calibration_source.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "services/calibration/files/calibration_set.hpp"
#include "services/command_line/imports/import_error.hpp"
#include "services/command_line/imports/pose_format.hpp"
#include "services/extraction/files/image_file.hpp"

namespace arcstart::command_line {
namespace {

namespace fs = std::filesystem;

// The number with which a file's name ends: 12 of frame0012.png.
std::optional<int> number_of(const fs::path& path) {
  const std::string stem = path.stem().string();
  std::size_t begin = stem.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(stem[begin - 1])) != 0) --begin;
  int number = 0;
  const auto [end, error] = std::from_chars(stem.data() + begin, stem.data() + stem.size(), number);
  if (error != std::errc{} || end != stem.data() + stem.size()) return std::nullopt;
  return number;
}

// Files of a folder by their number, of those that `wanted` names.
template <class Wanted>
std::map<int, std::string> numbered_files(const fs::path& folder, const Wanted& wanted) {
  std::map<int, std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto number = number_of(entry.path());
    if (!number || !wanted(entry.path())) continue;
    const auto [other, is_new] = files.emplace(*number, entry.path().string());
    if (!is_new)
      throw ImportError(fmt::format("{}: has the number of {}: keep one of them",
                                    std::max(entry.path().string(), other->second),
                                    std::min(entry.path().string(), other->second)));
  }
  return files;
}

// The numbers of a pose's file and the names before them, whatever separates them.
struct PoseText {
  std::vector<double> numbers;
  std::vector<std::string> names;
};

PoseText pose_text(const std::string& path) {
  std::ifstream file(path);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  for (char& letter : text)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 &&
        std::string("+-._").find(letter) == std::string::npos)
      letter = ' ';
  std::istringstream words(text);
  PoseText result;
  for (std::string word; words >> word;) {
    const std::size_t sign = word.starts_with('+') ? 1 : 0;
    double number = 0;
    const auto [end, error] =
        std::from_chars(word.data() + sign, word.data() + word.size(), number);
    if (error == std::errc{} && end == word.data() + word.size() && std::isfinite(number))
      result.numbers.push_back(number);
    else
      result.names.push_back(word);
  }
  return result;
}

RigidTransform pose_in_file(const std::string& path, const PoseConvention& convention) {
  const PoseFormat format = pose_formats().at(convention.format);
  PoseText text = pose_text(path);
  if (!is_pose_size(format, text.numbers.size()))
    throw ImportError(fmt::format("{}: {} numbers: --pose-format {} has {}", path,
                                  text.numbers.size(), convention.format, pose_columns(format)));
  std::string why;
  if (!text.names.empty() && format != PoseFormat::kMatrix) {
    text.names.insert(text.names.begin(), "index");
    why = header_error(format, convention.unit, text.names, "index");
  }
  if (!why.empty()) throw ImportError(fmt::format("{}: {}", path, why));
  const RigidTransform pose =
      pose_of(format, length_units().at(convention.unit), text.numbers, why);
  if (!why.empty()) throw ImportError(fmt::format("{}: {}", path, why));
  return pose;
}

std::map<int, RigidTransform> poses_in_files(const fs::path& folder,
                                             const PoseConvention& convention) {
  const auto is_pose_file = [](const fs::path& path) {
    const std::string ending = path.extension().string();
    return ending == ".txt" || ending == ".yaml" || ending == ".yml";
  };
  const fs::path place = fs::is_directory(folder / "poses") ? folder / "poses" : folder;
  std::map<int, RigidTransform> poses;
  std::vector<RigidTransform> all;
  for (const auto& [number, file] : numbered_files(place, is_pose_file))
    all.push_back(poses[number] = pose_in_file(file, convention));
  if (poses.empty())
    throw ImportError(folder.string() +
                      ": holds no poses: give poses.csv (index and a pose in each row), or a file "
                      "a pose whose name ends with its number, .txt or .yaml, there or in poses/");
  refuse_other_unit(all, convention, place.string());
  return poses;
}

std::map<int, RigidTransform> poses_in_table(const std::string& path,
                                             const PoseConvention& convention,
                                             std::vector<std::string>& notes) {
  const PoseTable read = read_pose_table(path, "index", convention, notes);
  std::map<int, RigidTransform> poses;
  for (std::size_t i = 0; i < read.T_base_tool.size(); ++i) {
    const CsvRow& row = read.table.rows[i];
    const double index = number_at(read.table, row, 0);
    if (index != std::floor(index) || index < 0 || index > 1e6)
      throw ImportError(
          fmt::format("{}: '{}' is no index of an image", read.table.where(row), row.fields[0]));
    if (!poses.emplace(static_cast<int>(index), read.T_base_tool[i]).second)
      throw ImportError(
          fmt::format("{}: index {} stands there twice", read.table.where(row), index));
  }
  return poses;
}

// The images of a folder, without those that no pose belongs to.
std::map<int, std::string> images_of(const fs::path& folder,
                                     const std::map<int, RigidTransform>& poses,
                                     std::vector<std::string>& notes) {
  auto images = numbered_files(
      folder, [](const fs::path& path) { return extraction::is_image_name(path.string()); });
  for (const auto& [number, pose] : poses)
    if (!images.contains(number))
      throw ImportError(fmt::format("{}: holds no image of pose {}, {:04}.png or the like",
                                    folder.string(), number, number));
  const auto left_out =
      std::erase_if(images, [&](const auto& image) { return !poses.contains(image.first); });
  if (left_out > 0)
    notes.push_back(fmt::format("{}: {} without a pose left out", folder.string(),
                                left_out == 1 ? "one image" : fmt::format("{} images", left_out)));
  return images;
}

void link_images(const std::map<int, std::string>& images, const fs::path& folder) {
  if (images.empty()) return;
  fs::create_directories(folder);
  for (const auto& [number, image] : images)
    fs::create_symlink(
        fs::canonical(image),
        folder / fmt::format("{:04}{}", number, fs::path(image).extension().string()));
}

void write_poses(const std::map<int, RigidTransform>& poses, const fs::path& path) {
  std::ofstream file(path);
  file << "index,x,y,z,qw,qx,qy,qz\n";
  for (const auto& [number, pose] : poses) {
    double p[3], q[4];
    transform_to_arrays(pose, p, q);
    file << fmt::format("{},{:.9g},{:.9g},{:.9g},{:.12g},{:.12g},{:.12g},{:.12g}\n", number, p[0],
                        p[1], p[2], q[0], q[1], q[2], q[3]);
  }
  if (!file.flush()) throw ImportError(path.string() + ": cannot be written");
}

}  // namespace

CalibrationSource read_calibration_source(const std::string& folder, const std::string& plate,
                                          const PoseConvention& convention,
                                          std::vector<std::string>& notes) {
  const fs::path root(folder);
  if (!fs::is_directory(root))
    throw ImportError(folder + ": is no folder: give one with images and poses");
  CalibrationSource source;
  source.plate = plate.empty() ? (root / "plate.yaml").string() : plate;
  if (!fs::exists(source.plate))
    throw ImportError(source.plate +
                      ": is missing: it describes the plate (pattern, columns, rows, pitch_mm, "
                      "radius_mm); name it by --plate");
  source.poses = fs::exists(root / "poses.csv")
                     ? poses_in_table((root / "poses.csv").string(), convention, notes)
                     : poses_in_files(root, convention);
  const fs::path grid = fs::is_directory(root / "grid")     ? root / "grid"
                        : fs::is_directory(root / "images") ? root / "images"
                                                            : root;
  source.grid = images_of(grid, source.poses, notes);
  if (fs::is_directory(root / "laser"))
    source.laser = images_of(root / "laser", source.poses, notes);
  return source;
}

void write_calibration_folder(const CalibrationSource& source, const std::string& folder) {
  if (fs::exists(folder)) throw ImportError(folder + ": exists already: name another folder");
  const fs::path unfinished(folder + ".part");
  try {
    fs::remove_all(unfinished);
    fs::create_directories(unfinished);
    fs::copy_file(source.plate, unfinished / "plate.yaml");
    write_poses(source.poses, unfinished / "poses.csv");
    link_images(source.grid, unfinished / "grid");
    link_images(source.laser, unfinished / "laser");
    calibration::read_calibration_set(unfinished.string());
    fs::rename(unfinished, folder);
  } catch (const fs::filesystem_error& error) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw ImportError(fmt::format("{}: cannot be written: {}", folder, error.code().message()));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    throw;
  }
}

}  // namespace arcstart::command_line
