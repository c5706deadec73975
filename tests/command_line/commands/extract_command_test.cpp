// arcstart extract as typed: files in, CSV and pictures out, exit codes.
#include "services/command_line/commands/extract_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "tests/extraction/support/stripe_image.hpp"

using namespace arcstart;
using namespace arcstart::command_line;
using namespace arcstart::extraction;
namespace fs = std::filesystem;

namespace {

struct Outcome {
  int exit_code;
  std::string out, err;
};

Outcome type(std::vector<std::string> words) {
  std::ostringstream out, err;
  auto* const out_before = std::cout.rdbuf(out.rdbuf());
  auto* const err_before = std::cerr.rdbuf(err.rdbuf());
  CLI::App program("arcstart");
  int exit_code = 0;
  add_extract_command(program, exit_code);
  words.insert(words.begin(), "extract");
  std::reverse(words.begin(), words.end());
  try {
    program.parse(words);
  } catch (const CLI::ParseError& error) {
    exit_code = program.exit(error, out, err) == 0 ? 0 : 2;
  }
  std::cout.rdbuf(out_before);
  std::cerr.rdbuf(err_before);
  return {exit_code, out.str(), err.str()};
}

struct Folder {
  fs::path path = fs::temp_directory_path() / ("arcstart-extract-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }
  std::string write(const std::string& name, const cv::Mat& image) const {
    cv::imwrite(*this / name, image);
    return *this / name;
  }
};

cv::Mat light_with_stripe() {
  cv::Mat light = darkness(300, 200);
  add_stripe(light, -10, 80, 310, 112, 150, 2);
  return light;
}
cv::Mat picture() { return expose(light_with_stripe(), 2); }

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

int lines_of(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("extract prints a stripe's centres as CSV") {
  const Folder folder;
  const Outcome outcome = type({folder.write("a.png", picture())});
  CHECK(outcome.exit_code == 0);
  const auto rows = rows_of(outcome.out);
  REQUIRE(rows.size() > 270);
  CHECK(rows[0] == std::vector<std::string>{"u", "v", "strength", "width", "segment", "sd"});
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == 6);
    const double u = std::stod(rows[i][0]), v = std::stod(rows[i][1]);
    REQUIRE(v == Approx(80 + 0.1 * (u + 10)).margin(0.3));
    REQUIRE(std::stod(rows[i][3]) == Approx(2).margin(0.8));
    REQUIRE(rows[i][4] == "0");
    REQUIRE(std::stod(rows[i][5]) > 0);
  }
  CHECK(outcome.err.find("a.png: ") != std::string::npos);
}

TEST_CASE(
    "extract takes several images and folders, names them, and adds second candidates on request") {
  const Folder folder;
  cv::Mat light = light_with_stripe();
  add_stripe(light, 80, 30, 250, 47, 40, 2);  // a reflection
  folder.write("a.png", picture());
  folder.write("b.png", expose(light, 2));
  folder.write("dark.PNG", cv::Mat(200, 300, CV_8U, cv::Scalar(5)));
  folder.write("dark.jpg", cv::Mat(200, 300, CV_8U, cv::Scalar(5)));
  std::ofstream(folder / "pose.txt") << "no image";
  const Outcome outcome = type(
      {folder.path.string(), "--all", "--csv", folder / "out.csv", "--picture", folder / "p.png"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  const auto rows = rows_of(read_text(folder / "out.csv"));
  REQUIRE(rows.size() > 500);
  CHECK(rows[0] ==
        std::vector<std::string>{"image", "u", "v", "strength", "width", "segment", "sd", "rank"});
  int seconds = 0;
  for (const auto& row : rows) {
    REQUIRE(row.size() == 8);
    if (row[7] != "1") continue;
    ++seconds;
    REQUIRE(row[0] == folder / "b.png");
    REQUIRE(std::stod(row[2]) == Approx(30 + 0.1 * (std::stod(row[1]) - 80)).margin(0.5));
  }
  CHECK(seconds > 150);
  for (const char* dark : {"dark.PNG", "dark.jpg"})
    CHECK(outcome.err.find(std::string(dark) + ": no stripe found") != std::string::npos);
  for (const char* name : {"p_a.png", "p_b.png", "p_dark.png"}) CHECK(fs::exists(folder / name));

  const Outcome chosen = type({folder / "b.png"});
  for (const auto& row : rows_of(chosen.out)) CHECK(row.size() == 6);
  CHECK(rows_of(chosen.out).size() < 310);
}

TEST_CASE("extract draws the centres in the picture where they are") {
  const Folder folder;
  const std::string path = folder.write("a.png", picture());
  REQUIRE(type({path, "--picture", folder / "p.png", "--csv", folder / "c.csv"}).exit_code == 0);
  const cv::Mat drawn = cv::imread(folder / "p.png");
  REQUIRE(drawn.cols == 300 * 8);
  int coloured = 0, near = 0;
  for (int v = 0; v < drawn.rows; ++v)
    for (int u = 0; u < drawn.cols; ++u) {
      const cv::Vec3b c = drawn.at<cv::Vec3b>(v, u);
      if (std::abs(c[0] - c[2]) < 60) continue;
      ++coloured;
      near += std::abs(v / 8.0 - 0.5 - 80 - 0.1 * (u / 8.0 + 9.5)) < 2;
    }
  CHECK(coloured > 5000);
  CHECK(near == coloured);
}

TEST_CASE("extract subtracts the laser-off image and takes the laser's colour") {
  const Folder folder;
  const cv::Mat grey = picture();
  cv::Mat bright = darkness(300, 200, 40), both;
  add_stripe(bright, 150, -10, 160, 210, 200, 3);  // always lit, and brighter
  both = bright + light_with_stripe();
  cv::Mat on, off;
  cv::merge(std::vector<cv::Mat>{expose(bright, 1, 2), expose(bright, 1, 3), expose(both, 1)}, on);
  cv::merge(std::vector<cv::Mat>{expose(bright, 1, 4), expose(bright, 1, 5), expose(bright, 1, 6)},
            off);
  const std::string on_path = folder.write("on.png", on), off_path = folder.write("off.png", off);
  const Outcome refused = type({on_path});
  CHECK(refused.exit_code == 2);
  CHECK(refused.out.empty());
  CHECK(lines_of(refused.err) == 1);
  CHECK(refused.err.find("--channel") != std::string::npos);
  const Outcome outcome = type({on_path, "--off", off_path, "--channel", "r"});
  CHECK(outcome.exit_code == 0);
  int on_line = 0, all = 0;
  for (const auto& row : rows_of(outcome.out)) {
    if (row[0] == "u") continue;
    ++all;
    on_line += std::abs(std::stod(row[1]) - 80 - 0.1 * (std::stod(row[0]) + 10)) < 1;
  }
  CHECK(all > 250);
  CHECK(on_line == all);
  const Outcome other_size = type({on_path, "--channel", "r", "--off",
                                   folder.write("small.png", grey(cv::Rect(0, 0, 50, 50)))});
  CHECK(other_size.exit_code == 2);
  CHECK(lines_of(other_size.err) == 1);
}

TEST_CASE("extract's exit codes: 1 nothing found, 2 bad input, each with one line") {
  const Folder folder;
  const Outcome dark = type({folder.write("dark.png", cv::Mat(200, 300, CV_8U, cv::Scalar(5)))});
  CHECK(dark.exit_code == 1);
  CHECK(lines_of(dark.err) == 1);
  std::ofstream(folder / "text.png") << "no image";
  fs::create_directories(folder.path / "empty");
  const std::string good = folder.write("a.png", picture());
  for (const auto& words : std::vector<std::vector<std::string>>{
           {folder / "text.png"},
           {folder / "empty"},
           {good, "--csv", folder / "absent/out.csv"},
           {good, "--picture", folder / "absent/out.png", "--csv", folder / "c.csv"},
           {folder.write("deep.png", cv::Mat(200, 300, CV_16U, cv::Scalar(5)))}}) {
    const Outcome outcome = type(words);
    INFO(words[0]);
    CHECK(outcome.exit_code == 2);
    CHECK(lines_of(outcome.err) == 1);
  }
  CHECK(type({folder / "absent.png"}).exit_code == 2);
  CHECK(type({}).exit_code == 2);
  CHECK(type({good, "--channel", "x"}).exit_code == 2);
  CHECK(type({good, "--sigma", "0.3"}).exit_code == 2);
  CHECK(type({good, "--sigma", "2.5"}).exit_code == 0);
  CHECK(type({good, "--as-found"}).exit_code == 0);
  CHECK(type({good, "--as-found"}).out != type({good}).out);
  CHECK(type({"--help"}).exit_code == 0);
  // One bad image among good ones: the good ones are done, and the exit tells of the bad.
  const Outcome mixed = type({good, folder / "text.png"});
  CHECK(mixed.exit_code == 2);
  CHECK(rows_of(mixed.out).size() > 250);
}

TEST_CASE("extract takes its settings from the cell's file") {
  const Folder folder;
  const std::string good = folder.write("a.png", picture());
  std::ofstream(folder / "cell.yaml") << "extraction:\n  least_strength: 190\n";
  CHECK(type({good}).exit_code == 0);
  CHECK(type({good, "--cell", folder / "cell.yaml"}).exit_code == 1);
}
