// Which settings hold for a scan: the cell's, with those of the scan's job over them.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/configuration.hpp"
#include "services/seam_finding/seam_finding_settings.hpp"

namespace arcstart::seam_finding {

// Section `jobs_of_scans` of the effective configuration in STATUS, and so of recordings: what held
// for the newest scans. Nobody writes it into a cell.yaml; replay reads it in place of the files.
struct JobsOfScans {
  std::vector<std::string> scan_id, name;
  std::vector<std::string> text;     // as jobs/NAME.yaml, every key with its value
  std::vector<std::string> refusal;  // why the job could not be used, empty where it could

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("scan_id", scan_id);
    visitor("name", name);
    visitor("text", text);
    visitor("refusal", refusal);
  }
};

struct JobInForce {
  std::string scan_id, name, text, refusal;
  SeamFindingSettings settings;
};

class JobBook {
 public:
  // Without jobs: a scan's job is a label.
  explicit JobBook(const SeamFindingSettings& cell = {}) : cell_settings_(cell) {}
  // Where `cell` has a section jobs_of_scans, that alone tells; else, with a section jobs, the
  // files. on_change: called with the section jobs_of_scans as it is from now on. Throws
  // ConfigurationError for a section that cannot be read.
  JobBook(const Configuration& cell, const SeamFindingSettings& settings,
          std::function<void(const std::string& section)> on_change = {});

  // A scan of this job: its file is read the first time that the scan is named. What holds is kept
  // for the scans named last.
  const JobInForce& take(std::int64_t scan_id, const std::string& job);
  // The cell's where nothing was taken of this scan.
  const SeamFindingSettings& settings(std::int64_t scan_id) const;

 private:
  JobInForce read(const std::string& scan_id, const std::string& job) const;
  void tell() const;

  SeamFindingSettings cell_settings_;
  Configuration cell_;
  bool by_files_ = false, by_statement_ = false;
  std::map<std::string, JobInForce> stated_;  // by scan_id
  std::function<void(const std::string&)> on_change_;
  std::deque<JobInForce> newest_;  // newest last
};

}  // namespace arcstart::seam_finding
