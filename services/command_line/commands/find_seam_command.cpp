#include "services/command_line/commands/find_seam_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "common/options.hpp"
#include "services/command_line/clouds/point_cloud_file.hpp"
#include "services/command_line/clouds/viewpoints.hpp"
#include "services/command_line/commands/say.hpp"
#include "services/command_line/output/cloud_answer.hpp"
#include "services/command_line/output/seam_json.hpp"
#include "services/seam_finding/background/plane_background.hpp"
#include "services/seam_finding/background/surface_background.hpp"
#include "services/seam_finding/consensus_seam.hpp"
#include "services/seam_finding/scan/seam_message.hpp"

namespace arcstart::command_line {
namespace {

constexpr std::uint64_t kSeed = 1;
// Answers from two places are one: within what chance draws move them in a cloud without stripes.
constexpr int kFewestPlaces = 3;  // as many as look at one side of a plate, of eight around it
constexpr double kSamePlace = 2, kSameAngle = 0.035;  // mm, rad

struct FindSeamOptions {
  std::string cloud, background, picture, stations, cell, joint, units = "mm";
  std::vector<double> viewpoint, search_direction;
  bool remove_plane = false, json = false;

  double mm_per_unit() const { return units == "m" ? 1000 : 1; }
};

PointCloud read_in_mm(const std::string& path, const FindSeamOptions& options) {
  PointCloud cloud = read_point_cloud(path);
  for (Eigen::Vector3d& point : cloud.points) point *= options.mm_per_unit();
  if (cloud.viewpoint) *cloud.viewpoint *= options.mm_per_unit();
  if (cloud.skipped > 0)
    say("find-seam", fmt::format("{}: {} of {} points are not finite: left out", path,
                                 cloud.skipped, cloud.points.size() + cloud.skipped));
  return cloud;
}

// A thousand times too large or too small is the likeliest mistake.
void check_extent(const seam_finding::ScanCloud& cloud, const FindSeamOptions& options) {
  Eigen::Vector3d low = cloud.points.front(), high = low;
  for (const auto& point : cloud.points) low = low.cwiseMin(point), high = high.cwiseMax(point);
  const double extent = (high - low).norm();
  if (extent < 10 && options.units == "mm")
    say("find-seam",
        fmt::format("the cloud measures {:.3g} mm in all: is it in metres? Then give --units m",
                    extent));
  if (extent > 1e5 && options.units == "m")
    say("find-seam",
        fmt::format("the cloud measures {:.3g} m in all: is it in mm? Then leave --units m away",
                    extent / 1000));
}

void set_viewpoint(seam_finding::ScanCloud& cloud, const PointCloud& file,
                   const FindSeamOptions& options, const std::optional<Plane>& plane) {
  if (!options.viewpoint.empty()) {
    cloud.viewpoint =
        Eigen::Map<const Eigen::Vector3d>(options.viewpoint.data()) * options.mm_per_unit();
    cloud.viewpoint_known = true;
  } else if (file.viewpoint) {
    cloud.viewpoint = *file.viewpoint;
    cloud.viewpoint_known = true;
    say("find-seam",
        fmt::format("seen from the file's VIEWPOINT {} mm", in_words(cloud.viewpoint, 1)));
  } else if (plane) {
    cloud.viewpoint = viewpoint_above(cloud.points, *plane);
    say("find-seam",
        fmt::format("no viewpoint given: taken as seen from {} mm, 1 m above its dominant plane, "
                    "on the side with more points",
                    in_words(cloud.viewpoint, 0)));
  }
}

bool same_seam(const seam_finding::SeamResult& a, const seam_finding::SeamResult& b) {
  const double cos = std::cos(kSameAngle);
  return (a.start - b.start).norm() < kSamePlace && (a.end - b.end).norm() < kSamePlace &&
         a.normals[0].dot(b.normals[0]) > cos && a.normals[1].dot(b.normals[1]) > cos;
}

// What is found from elsewhere, where nobody said where the sensor was and from the likeliest place
// there is no seam. One answer alone counts, and one that does not hang on the place; others are
// named.
void look_from_elsewhere(seam_finding::ScanCloud& cloud, seam_finding::SeamResult& result,
                         const std::vector<Eigen::Vector3d>& places,
                         const std::function<seam_finding::SeamResult()>& find) {
  struct Found {
    Eigen::Vector3d from;
    int places;
    seam_finding::SeamResult seam;
  };
  std::vector<Found> found;
  const Eigen::Vector3d first = cloud.viewpoint;
  for (const Eigen::Vector3d& place : places) {
    cloud.viewpoint = place;
    seam_finding::SeamResult seen = find();
    if (seen.verdict != seam_finding::SeamResult::Verdict::kFound) continue;
    const auto same = std::find_if(found.begin(), found.end(),
                                   [&](const Found& other) { return same_seam(other.seam, seen); });
    if (same != found.end())
      ++same->places;
    else
      found.push_back({place, 1, std::move(seen)});
  }
  cloud.viewpoint = first;
  const bool sure = found.size() == 1 && found[0].places >= kFewestPlaces;
  for (const Found& seen : found)
    say("find-seam",
        fmt::format("from {} mm a seam is seen, {} mm to {} mm{}", in_words(seen.from, 0),
                    in_words(seen.seam.start, 1), in_words(seen.seam.end, 1),
                    sure ? "" : ": if the sensor was there, give --viewpoint"));
  if (!sure) return;
  cloud.viewpoint = found[0].from;
  result = std::move(found[0].seam);
}

void set_search_direction(seam_finding::ScanCloud& cloud, const FindSeamOptions& options) {
  if (options.search_direction.empty()) {
    say("find-seam",
        "no search direction given: taken as running along the longest seam's increasing x, then "
        "y, then z");
    return;
  }
  cloud.search_direction =
      Eigen::Map<const Eigen::Vector3d>(options.search_direction.data()).normalized();
}

int run(const FindSeamOptions& options) {
  auto settings = options.cell.empty()
                      ? seam_finding::SeamFindingSettings{}
                      : Configuration::from_file(options.cell)
                            .read<seam_finding::SeamFindingSettings>("seam_finding");
  if (!options.joint.empty()) settings.joint_type = options.joint;
  const PointCloud file = read_in_mm(options.cloud, options);
  seam_finding::ScanCloud cloud = seam_finding::unorganised_cloud(file.points);
  check_extent(cloud, options);
  const auto plane = seam_finding::dominant_plane(cloud, kSeed);
  set_viewpoint(cloud, file, options, plane);
  set_search_direction(cloud, options);

  seam_finding::ScanCloud empty_cell;  // outlives the background that refers to it
  std::unique_ptr<seam_finding::Background> background =
      std::make_unique<seam_finding::NoBackground>();
  if (!options.background.empty()) {
    empty_cell = seam_finding::unorganised_cloud(read_in_mm(options.background, options).points);
    background = std::make_unique<seam_finding::SurfaceBackground>(empty_cell,
                                                                   settings.background_distance());
  } else if (options.remove_plane && plane) {
    background = std::make_unique<seam_finding::PlaneBackground>(cloud, *plane);
  }
  const auto find = [&] {
    return seam_finding::find_consensus_seam(cloud, *background, settings, kSeed);
  };
  seam_finding::SeamResult result = find();
  using Code = seam_finding::Reason::Code;
  const bool hangs_on_viewpoint =
      result.reason.code == Code::kNoJoint || result.reason.code == Code::kNoPair;
  if (hangs_on_viewpoint && plane && !cloud.viewpoint_known)
    look_from_elsewhere(cloud, result,
                        other_viewpoints(cloud.points, *plane, !options.remove_plane), find);

  for (const std::string& line : answer_lines(result)) say("find-seam", line);
  if (options.json) {
    seam_t seam = seam_finding::empty_seam();
    seam_finding::fill_in(seam, result);
    seam.points = cloud.size();
    std::cout << seam_to_json_line(seam) << "\n";
  }
  if (!options.picture.empty()) {
    draw_answer(cloud, result, plane, options.cloud, options.picture);
    say("find-seam", "picture: " + options.picture);
  }
  if (!options.stations.empty()) {
    write_stations(result, options.stations);
    say("find-seam", "stations: " + options.stations);
  }
  return result.verdict == seam_finding::SeamResult::Verdict::kFound ? 0 : 1;
}

std::string finite(const std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  return std::isfinite(value) && std::abs(value) < 1e9 ? "" : "must be finite, is " + text;
}

}  // namespace

void add_find_seam_command(CLI::App& parent, int& exit_code) {
  auto options = std::make_shared<FindSeamOptions>();
  Command command(parent, "find-seam", "Find the weld seam in a point cloud from a file");
  command.option("CLOUD", options->cloud, "PCD, PLY, or text with a point a line (XYZ, CSV, PTS)")
      .required();
  command.option("--background", options->background,
                 "Cloud of the empty cell, which is taken away");
  command
      .flag("--remove-plane", options->remove_plane,
            "Take away the dominant plane, what lies up to five times the cloud's tolerance "
            "above it, and all below")
      .excludes({"--background"});
  command.option("--units", options->units, "Of the files and of --viewpoint")
      .one_of({"mm", "m"})
      .show_default();
  command
      .option("--viewpoint", options->viewpoint,
              "Where the sensor was, x,y,z; without it the file's, else 1 m above the "
              "dominant plane, on the side with more points, and where no seam is seen from "
              "there, from wherever one alone is")
      .vector()
      .check(finite);
  command
      .option("--search-direction", options->search_direction,
              "The way of the search, x,y,z: where it begins, the seam starts; without it "
              "along the longest seam's increasing x, then y, then z")
      .vector()
      .check(finite);
  command
      .option("--joint", options->joint,
              "Joint wanted, else the cell's seam_finding.joint_type, which is tee where it is "
              "not said. any: tee, lap, butt or v; an outside_corner looks like the edge of a "
              "box and must be asked for; lap, butt and v need --search-direction")
      .one_of({"any", "tee", "corner", "outside_corner", "lap", "butt", "v"});
  command.flag("--json", options->json,
               "Print the answer on standard output, keys as in seam_t (mm and rad)");
  command.option("--picture", options->picture,
                 "PNG of the cloud with background, plates, seam and start, from two sides");
  command.option("--csv", options->stations,
                 "CSV of the places along the seam: distance from the start, position, "
                 "residual from the line (mm, empty where not measured), tack weld (0 or 1), gap "
                 "(mm, likewise)");
  command.option("--cell", options->cell,
                 "The cell's file, cell.yaml, whose section seam_finding is to be used");
  command.footer(
      "Without --background or --remove-plane nothing is taken away, and the line of a plate on "
      "the table counts as a seam.\n"
      "Exit: 0 found; 1 ambiguous or refused; 2 bad input.");
  command.run([options, &exit_code] {
    const auto& way = options->search_direction;
    if (!way.empty() && way[0] == 0 && way[1] == 0 && way[2] == 0)
      Command::refuse("--search-direction", "must not be 0,0,0");
    exit_code = run(*options);
  });
}

}  // namespace arcstart::command_line
