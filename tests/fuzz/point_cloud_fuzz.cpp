// PCD, PLY and text: any bytes give finite points or a PointCloudFileError, and memory in
// proportion to the file.
#include <cstdlib>

#include "services/command_line/clouds/point_cloud_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arcstart;
  using namespace arcstart::command_line;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  // The bytes alone, and behind the start of each format, so that the headers are reached at once.
  for (const std::string& whole :
       {std::string(bytes), "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n" + std::string(bytes),
        "ply\nformat ascii 1.0\n" + std::string(bytes),
        "ply\nformat binary_little_endian 1.0\n" + std::string(bytes),
        "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 9\nDATA binary_compressed\n" +
            std::string(bytes),
        "1 2 3\n" + std::string(bytes)}) {
    try {
      const PointCloud cloud = parse_point_cloud(whole, "cloud");
      for (const auto& point : cloud.points)
        if (!point.allFinite()) std::abort();
    } catch (const PointCloudFileError&) {
    }
  }
  return 0;
}
