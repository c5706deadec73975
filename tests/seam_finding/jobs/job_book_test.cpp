// Settings by job: files, what STATUS says of them, and the same again from that.
#include "services/seam_finding/jobs/job_book.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/seam_finding/scan/service_life.hpp"

using namespace arcstart;
using namespace arcstart::seam_finding;
using namespace arcstart::seam_finding::synthetic;
using Catch::Contains;

namespace {

struct JobCell {
  Folder folder;
  JobCell() {
    fs::create_directories(folder.path / "jobs");
    write("cell.yaml", "jobs: {folder: jobs}\nseam_finding: {angle_tolerance_deg: 20}\n");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path / name) << text;
  }
  Configuration configuration() const {
    return Configuration::from_file((folder.path / "cell.yaml").string());
  }
  JobBook book(std::string* stated = nullptr) const {
    return JobBook(configuration(), configuration().read<SeamFindingSettings>("seam_finding"),
                   [stated](const std::string& section) {
                     if (stated) *stated = section;
                   });
  }
};

}  // namespace

TEST_CASE("a job's keys stand over the cell's, for its scans alone") {
  const JobCell cell;
  cell.write("jobs/bracket.yaml",
             "seam_finding: {joint_type: lap, weld_start: far, bias_mm: [0, 1, -0.5]}\n"
             "job: {user_frame: fixture, fixture_holds: [along]}\n");
  JobBook book = cell.book();
  const JobInForce job = book.take(17, "bracket");
  CHECK(job.refusal.empty());
  CHECK(job.settings.joint_type == "lap");
  CHECK(job.settings.weld_start == WeldStart::kFar);
  CHECK(job.settings.bias_mm == std::array<double, 3>{0, 1, -0.5});
  CHECK(job.settings.angle_tolerance_deg == 20);
  CHECK(book.take(18, "").settings.joint_type == "tee");
  CHECK(book.settings(17).joint_type == "lap");
}

TEST_CASE("what is wrong with a job is one line that names file, line and key") {
  const JobCell cell;
  cell.write("jobs/key.yaml", "seam_finding:\n  joint: lap\n");
  cell.write("jobs/type.yaml", "seam_finding:\n  weld_start: 3\n");
  cell.write("jobs/box.yaml", "seam_finding:\n  search_box_mm: [0, 0, 0, 1, 1, -1]\n");
  cell.write("jobs/section.yaml", "seam_finding: {}\nextraction: {}\n");
  cell.write("jobs/cells.yaml", "seam_finding:\n  background_distance_mm: 2\n");
  cell.write("jobs/held.yaml", "job:\n  fixture_holds: [sideways]\n");
  cell.write("jobs/yaml.yaml", "seam_finding: [\n");
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"key", "key.yaml:2: seam_finding.joint: unknown key"},
      {"type", "type.yaml:2: seam_finding.weld_start: must be one of near, far"},
      {"box", "box.yaml:2: seam_finding.search_box_mm: must have its lower corner first"},
      {"section", "section.yaml:2: extraction: unknown section"},
      {"cells", "seam_finding.background_distance_mm: is the cell's alone"},
      {"held", "held.yaml:2: job.fixture_holds: must be of along, turn"},
      {"yaml", "not YAML"},
      {"missing", "missing.yaml: cannot be read"},
      {"../cell", "a job's name is of letters"},
      {"/etc/passwd", "a job's name is of letters"},
      {".hidden", "a job's name is of letters"}};
  JobBook book = cell.book();
  std::int64_t scan_id = 1;
  for (const auto& [name, line] : wrong) {
    const JobInForce& job = book.take(++scan_id, name);
    CHECK_THAT(job.refusal, Contains(line));
    CHECK(job.refusal.find('\n') == std::string::npos);
    CHECK(job.settings.joint_type == "tee");
  }
}

TEST_CASE("what was in force is stated, and holds again without the file") {
  const JobCell cell;
  cell.write("jobs/a.yaml", "seam_finding: {joint_type: butt, approach_mm: 33.3}\n");
  std::string stated;
  JobBook book = cell.book(&stated);
  book.take(5, "a");
  // The file changes: the scan that has begun keeps its settings, the next has the new ones.
  cell.write("jobs/a.yaml", "seam_finding: {joint_type: v}\n");
  CHECK(book.take(5, "a").settings.joint_type == "butt");
  CHECK(book.take(6, "a").settings.joint_type == "v");
  book.take(7, "none");
  fs::remove(cell.folder.path / "jobs/a.yaml");

  const auto again = Configuration::from_text("jobs: {folder: jobs}\n" + stated, "recording");
  JobBook replayed(again, SeamFindingSettings{});
  CHECK(write_settings("s", replayed.take(5, "a").settings) ==
        write_settings("s", book.take(5, "a").settings));
  CHECK(replayed.take(6, "a").settings.joint_type == "v");
  CHECK(replayed.take(7, "none").refusal == book.take(7, "none").refusal);
  CHECK_THAT(replayed.take(8, "a").refusal, Contains("does not tell the settings of job a"));
}

TEST_CASE("without a section jobs a scan's job is a label") {
  JobBook book(Configuration::from_text("seam_finding: {}", "cell.yaml"), SeamFindingSettings{});
  CHECK(book.take(5, "../anything").refusal.empty());
}

TEST_CASE("a scan of a job is answered by its settings, one of no job that is there is refused") {
  const JobCell cell;
  cell.write("jobs/job.yaml", "seam_finding: {weld_start: far, background_job: job}\n");
  const auto answers = [&](const ScanMessages& background, const ScanMessages& work) {
    Life life("", patient(), cell.book());
    life.scan(background);
    life.scan(work);
    return life.seams;
  };
  const auto named = [](ScanMessages messages, const std::string& job) {
    for (scan_t* state : {&messages.scanning, &messages.ended}) state->job = job;
    return messages;
  };
  Life plain;
  plain.scan(scans().empty);
  plain.scan(scans().work);
  const seam_t& searched = plain.seams.at(1);

  const auto of_job = answers(scans().empty, scans().work);
  REQUIRE(of_job.size() == 2);
  REQUIRE(of_job[1].verdict == seam_t::FOUND);
  CHECK(std::equal(of_job[1].start, of_job[1].start + 3, searched.end));
  CHECK(std::equal(of_job[1].end, of_job[1].end + 3, searched.start));

  const auto of_none = answers(scans().empty, named(scans().work, "other"));
  CHECK(of_none.at(1).verdict == seam_t::REFUSED);
  CHECK(of_none.at(1).refusal == seam_t::CALL);
  CHECK_THAT(of_none.at(1).reason, Contains("other.yaml: cannot be read"));

  // The background of another job does not serve this one.
  cell.write("jobs/other.yaml", "{}");
  const auto foreign = answers(named(scans().empty, "other"), scans().work);
  CHECK(foreign.at(0).verdict == seam_t::BACKGROUND_STORED);
  CHECK(foreign.at(1).refusal == seam_t::NO_BACKGROUND);
}
