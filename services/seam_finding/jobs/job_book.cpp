#include "services/seam_finding/jobs/job_book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/jobs/job_file.hpp"

namespace arcstart::seam_finding {
namespace {

// A scan that runs, the one before that waits for its last profile, and one to spare.
constexpr std::size_t kScansKept = 3;

// What a background is made by, and what the service needs between scans, no job can change.
std::string error_against_cell(const SeamFindingSettings& job, const SeamFindingSettings& cell) {
  const char* key =
      job.background_rule != cell.background_rule                 ? "background_rule"
      : job.background_distance_mm != cell.background_distance_mm ? "background_distance_mm"
      : job.background_neighbours != cell.background_neighbours   ? "background_neighbours"
      : job.dead_chain_s != cell.dead_chain_s                     ? "dead_chain_s"
      : job.backgrounds_kept != cell.backgrounds_kept             ? "backgrounds_kept"
      : job.results_kept != cell.results_kept                     ? "results_kept"
                                                                  : nullptr;
  return key ? fmt::format("seam_finding.{}: is the cell's alone: set it in cell.yaml", key) : "";
}

SeamFindingSettings settings_of(const JobFile& file, const SeamFindingSettings& cell) {
  return file.read<SeamFindingSettings>("seam_finding", cell);
}

}  // namespace

JobBook::JobBook(const Configuration& cell, const SeamFindingSettings& settings,
                 std::function<void(const std::string& section)> on_change)
    : cell_settings_(settings),
      cell_(cell),
      by_files_(cell.has("jobs")),
      by_statement_(cell.has("jobs_of_scans")),
      on_change_(std::move(on_change)) {
  if (!by_statement_) return;
  const auto stated = cell.read<JobsOfScans>("jobs_of_scans");
  const std::size_t count = stated.scan_id.size();
  if (stated.name.size() != count || stated.text.size() != count || stated.refusal.size() != count)
    throw ConfigurationError(cell.name() + ": jobs_of_scans: its lists must be of one length");
  for (std::size_t i = 0; i < count; ++i) {
    JobInForce job{stated.scan_id[i], stated.name[i], stated.text[i], stated.refusal[i], settings};
    if (job.refusal.empty())
      job.settings = settings_of(
          JobFile::from_text(job.text, fmt::format("{}: job {}", cell.name(), job.name)), settings);
    stated_[job.scan_id] = job;
  }
}

const JobInForce& JobBook::take(std::int64_t scan_id, const std::string& job) {
  const std::string id = fmt::format("{}", scan_id);
  for (const JobInForce& known : newest_)
    if (known.scan_id == id) return known;
  newest_.push_back(read(id, job));
  if (newest_.size() > kScansKept) newest_.pop_front();
  tell();
  return newest_.back();
}

const SeamFindingSettings& JobBook::settings(std::int64_t scan_id) const {
  const std::string id = fmt::format("{}", scan_id);
  for (const JobInForce& known : newest_)
    if (known.scan_id == id) return known.settings;
  return cell_settings_;
}

JobInForce JobBook::read(const std::string& scan_id, const std::string& name) const {
  JobInForce job{scan_id, name, "", "", cell_settings_};
  if (name.empty() || (!by_files_ && !by_statement_)) return job;
  if (by_statement_) {
    const auto stated = stated_.find(scan_id);
    if (stated != stated_.end() && stated->second.name == name) return stated->second;
    // Of a cell without jobs: it was a label.
    if (by_files_) job.refusal = "the recording does not tell the settings of job " + name;
    return job;
  }
  job.refusal = job_name_error(name);
  if (!job.refusal.empty()) return job;
  try {
    const std::string path = job_path(cell_, name);
    const JobFile file = JobFile::from_file(path);
    job.settings = settings_of(file, cell_settings_);
    if (const std::string error = error_against_cell(job.settings, cell_settings_); !error.empty())
      throw ConfigurationError(path + ": " + error);
    job.text = write_settings("seam_finding", job.settings) +
               write_settings("job", file.read<JobSettings>("job"));
  } catch (const ConfigurationError& error) {
    job.refusal = error.what();
    job.settings = cell_settings_;
  }
  return job;
}

void JobBook::tell() const {
  if (!on_change_) return;
  JobsOfScans all;
  for (const JobInForce& job : newest_) {
    if (job.text.empty() && job.refusal.empty()) continue;
    all.scan_id.push_back(job.scan_id);
    all.name.push_back(job.name);
    all.text.push_back(job.text);
    all.refusal.push_back(job.refusal);
  }
  on_change_(all.scan_id.empty() ? "" : write_settings("jobs_of_scans", all));
}

}  // namespace arcstart::seam_finding
