// The program's own contract: exit codes, JSON on standard output, words on standard error.
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "paths.hpp"
#include "tests/command_line/support/synthetic_recording.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::test;
using Catch::Matchers::Contains;

namespace {

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(const Folder& folder, const std::string& arguments, const std::string& out = "out") {
  const auto text_of = [&](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(folder / name).rdbuf();
    return text.str();
  };
  const std::string command =
      "cd " + folder.path() + " && " ARCSTART_PROGRAM " " + arguments + " >" + out + " 2>err";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out == "out" ? text_of(out) : "",
          text_of("err")};
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("what cannot be printed is an error, not a result") {
  const Folder folder;
  for (const std::string arguments : {"--help", "replay --json " ARCSTART_SOURCE "/logs/lap.lcm"}) {
    INFO(arguments);
    const Outcome full = run(folder, arguments, "/dev/full");
    CHECK(full.code == 2);
    CHECK_THAT(full.err, Contains("standard output cannot be written: No space left on device"));
  }
}

TEST_CASE("arcstart and each subcommand tell all of themselves") {
  const Folder folder;
  const Outcome all = run(folder, "--help");
  CHECK(all.code == 0);
  for (const std::string command :
       {"scan", "replay", "import", "extract", "find-seam", "calibrate", "monitor"}) {
    CHECK_THAT(all.out, Contains(command));
    const Outcome help = run(folder, command + " --help");
    CHECK(help.code == 0);
    CHECK_THAT(help.out, Contains("Exit: 0"));
  }
  CHECK_THAT(run(folder, "import scan --help").out, Contains("Exit: 0"));
  CHECK(run(folder, "").code == 2);
  CHECK(run(folder, "weld").code == 2);
  CHECK(run(folder, "scan").code == 2);
  CHECK(run(folder, "scan --kind both").code == 2);
  CHECK(run(folder, "replay").code == 2);
  CHECK(run(folder, "--version").code == 0);
}

TEST_CASE("arcstart replay prints each seam, and its exit code is its verdict") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  folder.save("good.lcm", record(recorded));
  const Outcome good = run(folder, "replay --json good.lcm");
  CHECK(good.code == 0);
  REQUIRE(lines(good.out) == 2);
  std::istringstream out(good.out);
  std::string line;
  std::getline(out, line);
  CHECK(nlohmann::json::parse(line)["scan_id"] == kBackgroundScan);
  std::getline(out, line);
  const auto seam = nlohmann::json::parse(line);
  CHECK(seam["joint_type"] == "tee");
  CHECK(seam["start"].size() == 3);
  CHECK_THAT(good.err, Contains("found tee"));
  CHECK(run(folder, "replay --json good.lcm").out == good.out);
  CHECK(run(folder, "replay good.lcm").out.empty());

  recorded.workpiece = false;
  folder.save("background.lcm", record(recorded));
  const Outcome background = run(folder, "replay background.lcm");
  CHECK(background.code == 0);
  CHECK_THAT(background.err, Contains("background alone"));

  recorded.workpiece = true;
  recorded.background = false;
  folder.save("workpiece.lcm", record(recorded));
  const Outcome refused = run(folder, "replay workpiece.lcm");
  CHECK(refused.code == 1);
  CHECK_THAT(refused.err, Contains("refused: no background"));
  CHECK(run(folder, "replay workpiece.lcm --background background.lcm").code == 0);

  Events cut = record(recorded);
  std::erase_if(cut,
                [](const auto& event) { return event.timestamp > kWorkpieceScan + 2'000'000; });
  folder.save("cut.lcm", cut);
  const Outcome unanswered = run(folder, "replay cut.lcm");
  CHECK(unanswered.code == 1);
  CHECK_THAT(unanswered.err, Contains("no answer: the recording ends within it"));
}

TEST_CASE("arcstart replay writes the encoded answers for a comparison") {
  const Folder folder;
  Recorded recorded;
  recorded.profiles = true;
  folder.save("good.lcm", record(recorded));
  CHECK(run(folder, "replay good.lcm --seams seams").code == 0);
  std::ifstream file(folder / "seams", std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(file)), {});
  std::vector<std::int64_t> scans;
  for (std::size_t at = 0; at < bytes.size();) {
    REQUIRE(bytes.size() - at > 4);
    std::uint32_t size = 0;
    for (int i = 3; i >= 0; --i) size = size << 8 | bytes[at + static_cast<std::size_t>(i)];
    at += 4;
    REQUIRE(bytes.size() - at >= size);
    seam_t seam;
    REQUIRE(seam.decode(&bytes[at], 0, static_cast<int>(size)) == static_cast<int>(size));
    scans.push_back(seam.scan_id);
    at += size;
  }
  CHECK(scans == std::vector<std::int64_t>{kBackgroundScan, kWorkpieceScan});

  recorded.background = false;
  folder.save("workpiece.lcm", record(recorded));
  CHECK(run(folder, "replay workpiece.lcm --seams refused").code == 1);
  CHECK(std::filesystem::file_size(folder / "refused") > 4);

  // Opens, and is full.
  for (const std::string path : {"/dev/full", "no/such/folder/seams", "."}) {
    const Outcome outcome = run(folder, "replay good.lcm --seams " + path);
    INFO(path << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.ends_with("\n"));
    CHECK_THAT(outcome.err, Contains("replay: " + path + ": cannot be written: "));
  }
}

TEST_CASE("what arcstart replay cannot read ends with 2 and one line") {
  const Folder folder;
  std::ofstream(folder / "text.lcm") << "this is no recording at all, but a text of some length";
  std::ofstream(folder / "cell.yaml") << "seam_finding:\n  no_such_key: 1\n";
  Recorded recorded;
  recorded.stripes = true;
  Events events = record(recorded);
  folder.save("good.lcm", events);
  std::erase_if(events, [](const auto& event) { return event.channel == "ROBOT0_POSE"; });
  folder.save("no_pose.lcm", events);
  // As the version before wrote it: image_t's former hash.
  events = record(recorded);
  events.front().channel = "LASER0_IMAGE";
  events.front().bytes = {0x3c, 0x00, 0x0d, 0x0d, 0x77, 0xf4, 0xad, 0xa4, 0, 0, 0, 0};
  folder.save("former.lcm", events);
  for (const std::string arguments : {"missing.lcm", "text.lcm", ".", "no_pose.lcm", "former.lcm",
                                      "good.lcm --cell cell.yaml", "good.lcm --sensor LASER9"}) {
    const Outcome outcome = run(folder, "replay " + arguments);
    INFO(arguments << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(lines(outcome.err) == 1);
  }
}

TEST_CASE("arcstart prints for scripts what they need") {
  const Folder folder;
  Recorded recorded;
  recorded.stripes = true;
  folder.save("a.lcm", record(recorded));
  CHECK(run(folder, "replay --print-source-channels a.lcm").out ==
        "(LASER0_SCAN|LASER0_CALIBRATION|ROBOT0_POSE|LASER0_STRIPE)\n");
  const Outcome settings = run(folder, "replay --print-settings a.lcm");
  std::ofstream(folder / "cell.yaml") << settings.out;
  CHECK(run(folder, "replay --cell cell.yaml a.lcm").code == 0);
  std::ofstream(folder / "bus.yaml") << "bus:\n  port: 7700\n  image_port: 7701\n";
  const Outcome urls = run(folder, "monitor --print-urls --cell bus.yaml");
  CHECK(urls.code == 0);
  CHECK(urls.out ==
        "udpm://239.255.76.67:7700?ttl=0&recv_buf_size=4194304\nudpm://"
        "239.255.76.67:7701?ttl=0&recv_buf_size=4194304\n");
}
