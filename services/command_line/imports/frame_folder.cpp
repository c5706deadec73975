#include "services/command_line/imports/frame_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>

#include "services/command_line/imports/csv_table.hpp"
#include "services/command_line/imports/import_error.hpp"
#include "services/extraction/files/image_file.hpp"

namespace arcstart::command_line {
namespace {

namespace fs = std::filesystem;

std::optional<int> index_of(const std::string& text) {
  int index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size() || index < 0) return std::nullopt;
  return index;
}

std::map<int, std::string> images_in(const fs::path& folder) {
  std::error_code error;
  std::map<int, std::string> images;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (!extraction::is_image_name(path.string())) continue;
    const auto index = index_of(path.stem().string());
    if (!index) throw ImportError(path.string() + ": is not named after its index, as in 0007.png");
    const auto [other, is_new] = images.emplace(*index, path.string());
    if (!is_new)
      throw ImportError(fmt::format("{}: has the index of {}: keep one of them",
                                    std::max(path.string(), other->second),
                                    std::min(path.string(), other->second)));
  }
  if (error)
    throw ImportError(
        fmt::format("{}: is missing or cannot be read ({}): it holds the images, "
                    "NNNN.png",
                    folder.string(), error.message()));
  if (images.empty())
    throw ImportError(folder.string() +
                      ": holds no image NNNN.png, .jpg, .jpeg, .bmp, .tif or .tiff");
  return images;
}

// By index.
struct Stamp {
  std::int64_t utime;
  CsvRow row;
};

std::map<int, Stamp> stamps_of(const CsvTable& table) {
  const std::string columns = "index,utime";
  const auto& header = table.header.fields;
  if (!header.empty() && header != std::vector<std::string>{"index", "utime"} &&
      header != std::vector<std::string>{"index", "utime_received"})
    throw ImportError(fmt::format("{}: the columns must be index,utime or index,utime_received, us",
                                  table.where(table.header)));
  std::map<int, Stamp> stamps;
  for (const CsvRow& row : table.rows) {
    require_fields(table, row, 2, columns);
    const auto index = index_of(row.fields[0]);
    if (!index)
      throw ImportError(
          fmt::format("{}: '{}' is no index of an image", table.where(row), row.fields[0]));
    if (!stamps.emplace(*index, Stamp{utime_at(table, row, 1), row}).second)
      throw ImportError(fmt::format("{}: index {} stands there twice", table.where(row), *index));
  }
  const Stamp* before = nullptr;
  for (const auto& [index, stamp] : stamps) {
    if (before && stamp.utime <= before->utime)
      throw ImportError(
          fmt::format("{}: the time of index {}, {}, is not later than that of the image before it",
                      table.where(stamp.row), index, stamp.utime));
    before = &stamp;
  }
  return stamps;
}

}  // namespace

std::vector<StampedFrame> read_frame_folder(const std::string& folder,
                                            std::vector<std::string>& notes) {
  const fs::path root(folder);
  const CsvTable table = read_csv((root / "frames.csv").string(), "index,utime of each image, us");
  const auto stamps = stamps_of(table);
  const auto images = images_in(root / "frames");
  std::vector<StampedFrame> frames;
  for (const auto& [index, stamp] : stamps) {
    const auto image = images.find(index);
    if (image == images.end())
      throw ImportError(fmt::format("{}: index {} has no image in {}", table.where(stamp.row),
                                    index, (root / "frames").string()));
    frames.push_back({index, stamp.utime, image->second});
  }
  const auto unstamped = [&](const auto& image) { return !stamps.contains(image.first); };
  if (const auto count = std::count_if(images.begin(), images.end(), unstamped); count > 0)
    notes.push_back(fmt::format(
        "{}: {} without a row in frames.csv left out, {} first", (root / "frames").string(),
        count == 1 ? "one image" : fmt::format("{} images", count),
        fs::path(std::find_if(images.begin(), images.end(), unstamped)->second)
            .filename()
            .string()));
  return frames;
}

}  // namespace arcstart::command_line
