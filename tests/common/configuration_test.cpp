#include "common/configuration.hpp"

#include <catch2/catch.hpp>

using namespace arcstart;

namespace {

enum class Shade { kLight, kDark };

struct Sample {
  double sigma_px = 2.5;
  int count = 3;
  bool fast = true;
  std::string mode = "plain";
  Shade shade = Shade::kDark;
  std::array<double, 3> offset{0.1, 0, -1.0 / 3};
  std::vector<std::string> names{"a \"quoted\"", "b: c"};

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("sigma_px", sigma_px, between(0.5, 12));
    visitor("count", count, positive());
    visitor("fast", fast);
    visitor("mode", mode, one_of({"plain", "fancy"}));
    visitor("shade", shade, Names{{"light", "dark"}});
    visitor("offset", offset);
    visitor("names", names);
  }
};

std::string error_of(const std::string& text) {
  try {
    Configuration::from_text(text, "cell.yaml").read<Sample>("extraction");
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a section that is absent or empty has its defaults") {
  CHECK(Configuration().read<Sample>("extraction").sigma_px == 2.5);
  CHECK(Configuration::from_text("", "x").read<Sample>("extraction").count == 3);
  CHECK(Configuration::from_text("extraction:\n", "x").read<Sample>("extraction").fast);
  CHECK(Configuration::from_text("bus: {port: 1}", "x").read<Sample>("extraction").fast);
}

TEST_CASE("keys given replace defaults") {
  const auto sample = Configuration::from_text(
                          "extraction:\n  sigma_px: 4\n  offset: [1, 2, 3]\n  fast: false\n", "x")
                          .read<Sample>("extraction");
  CHECK(sample.sigma_px == 4);
  CHECK(sample.offset == std::array<double, 3>{1, 2, 3});
  CHECK_FALSE(sample.fast);
  CHECK(sample.count == 3);
}

TEST_CASE("a wrong configuration is told with file, line and key") {
  CHECK(error_of("extraction:\n  count: 1\n  sigma: 2\n") ==
        "cell.yaml:3: extraction.sigma: unknown key; known are count, fast, mode, names, offset, "
        "shade, "
        "sigma_px");
  CHECK(error_of("extraction: {sigma_px: wide}") ==
        "cell.yaml:1: extraction.sigma_px: must be a number, is 'wide'");
  CHECK(error_of("extraction: {sigma_px: -1}") ==
        "cell.yaml:1: extraction.sigma_px: must lie between 0.5 and 12, is '-1'");
  CHECK(error_of("extraction: {sigma_px: .nan}").find("must be a number") != std::string::npos);
  CHECK(error_of("extraction: {count: 1.5}").find("whole number") != std::string::npos);
  CHECK(error_of("extraction: {fast: 3}").find("true or false") != std::string::npos);
  CHECK(error_of("extraction: {mode: odd}").find("one of plain, fancy") != std::string::npos);
  CHECK(error_of("extraction: {offset: [1, 2]}").find("list of 3 numbers") != std::string::npos);
  CHECK(error_of("extraction: {offset: 1}").find("list of numbers") != std::string::npos);
  CHECK(error_of("extraction: {count: 1, count: 2}").find("twice") != std::string::npos);
  CHECK(error_of("extraction: 3").find("map of keys") != std::string::npos);
  CHECK(error_of("\n\nextract: {}").starts_with("cell.yaml:3: extract: unknown section"));
  CHECK(error_of("extraction: [").starts_with("cell.yaml:1: not YAML"));
  CHECK(error_of("- 1").find("map of sections") != std::string::npos);
  CHECK_THROWS_WITH(Configuration::from_file("/nonexistent/cell.yaml"),
                    Catch::Contains("/nonexistent/cell.yaml: cannot be read"));
}

TEST_CASE("what is written is read back bit by bit") {
  Sample sample;
  sample.sigma_px = 0.1 + 0.2 + 1;
  sample.mode = "fancy";
  sample.offset = {1e-300, 12345678.9, -0.0};
  const std::string text = write_settings("extraction", sample);
  const auto again = Configuration::from_text(text, "x").read<Sample>("extraction");
  CHECK(again.sigma_px == sample.sigma_px);
  CHECK(again.offset == sample.offset);
  CHECK(again.names == sample.names);
  CHECK(write_settings("extraction", again) == text);
}

TEST_CASE("the fingerprint is FNV-1a") {
  CHECK(fingerprint("") == "cbf29ce484222325");
  CHECK(fingerprint("foobar") == "85944171f73967e8");  // the authors' test vector
}

TEST_CASE("an enumeration's value is given by its name") {
  const auto shade = [](const std::string& text) {
    return Configuration::from_text(text, "x").read<Sample>("extraction").shade;
  };
  CHECK(shade("") == Shade::kDark);
  CHECK(shade("extraction: {shade: light}") == Shade::kLight);
  CHECK(shade(write_settings("extraction", Sample{.shade = Shade::kLight})) == Shade::kLight);
  CHECK(error_of("extraction: {shade: grey}") ==
        "cell.yaml:1: extraction.shade: must be one of light, dark, is 'grey'");
}
