// cell.yaml: any text is read or refused with a ConfigurationError, and what is read can be written
// and read again.
#include <cstdlib>

#include "common/configuration.hpp"

namespace {

struct EveryKind {
  bool flag = true;
  int count = 1;
  double length_mm = 1;
  std::string name = "a";
  std::array<double, 3> vector{};
  std::vector<std::string> names;

  template <class Visitor>
  void visit(Visitor& visitor) {
    visitor("flag", flag);
    visitor("count", count, arcstart::positive());
    visitor("length_mm", length_mm, arcstart::between(0, 10));
    visitor("name", name);
    visitor("vector", vector);
    visitor("names", names);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace arcstart;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    // The text alone, and as the value of a section, so that keys are reached at once.
    for (const std::string& whole : {text, "extraction: {" + text + "}"}) {
      const auto settings =
          Configuration::from_text(whole, "cell.yaml").read<EveryKind>("extraction");
      const std::string written = write_settings("extraction", settings);
      if (write_settings(
              "extraction",
              Configuration::from_text(written, "again").read<EveryKind>("extraction")) != written)
        std::abort();
    }
  } catch (const ConfigurationError&) {
  }
  return 0;
}
