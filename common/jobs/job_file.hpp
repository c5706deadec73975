// jobs/NAME.yaml: in what a job differs from its cell. Written as cell.yaml is, with two sections:
// `seam_finding`, whose keys stand in place of cell.yaml's for scans of this job, and `job`, for
// what a cell has none of.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "common/configuration.hpp"

namespace arcstart {

// Section `jobs` of cell.yaml. Without it a scan's job is a label and changes nothing.
struct JobsSettings {
  std::string folder = "jobs";  // beside cell.yaml, where it does not begin with /

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("folder", folder);
  }
};

// Section `job` of jobs/NAME.yaml: how a part is compared with its taught master.
struct JobSettings {
  // The frame in which the robot's program was taught, and in which offsets are given: its name,
  // and where it lies in base, X Y Z mm, W P R deg.
  std::string user_frame = "base";
  std::array<double, 6> user_frame_xyzwpr = {};
  // What the seam need not tell, for the fixture does: `along` it, `turn` about it.
  std::vector<std::string> fixture_holds;
  // From the master; more is not this part, or not in its place.
  double offset_max_mm = 50, offset_max_deg = 15;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("user_frame", user_frame);
    visitor("user_frame_xyzwpr", user_frame_xyzwpr);
    visitor("fixture_holds", fixture_holds, are_freedoms);
    visitor("offset_max_mm", offset_max_mm, between(0.1, 2000));
    visitor("offset_max_deg", offset_max_deg, between(0.1, 90));
  }
  static std::string are_freedoms(const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (name != "along" && name != "turn") return "must be of along, turn";
    return "";
  }
  bool holds(const std::string& freedom) const {
    return std::find(fixture_holds.begin(), fixture_holds.end(), freedom) != fixture_holds.end();
  }
};

// Letters, digits, '-', '_' and '.', the first a letter or digit, at most 64: why a text cannot
// name a job, empty where it can. Names come from the bus, and name files.
std::string job_name_error(const std::string& name);

// "FOLDER/NAME.yaml" with the folder of the cell's file. name: a job's name.
std::string job_path(const Configuration& cell, const std::string& name);

class JobFile {
 public:
  // Both throw ConfigurationError: cannot be read, not YAML, an unknown section.
  static JobFile from_file(const std::string& path);
  static JobFile from_text(const std::string& text, const std::string& name);

  // The section's keys over `settings`; every key must be known, of the right type and possible.
  template <class Settings>
  Settings read(const std::string& section, Settings settings = {}) const {
    SectionReader reader = section_reader(section);
    settings.visit(reader);
    reader.refuse_unknown_keys();
    return settings;
  }

 private:
  SectionReader section_reader(const std::string& section) const;

  std::string name_;
  std::shared_ptr<const YAML::Node> root_;
};

}  // namespace arcstart
