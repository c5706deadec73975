#include "common/configuration.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

namespace arcstart {
namespace {

// A section is a service's folder, or the bus that all share.
const std::set<std::string> kSections = {"bus",         "sensor_capture", "robot_pose",
                                         "extraction",  "reconstruction", "seam_finding",
                                         "calibration", "cell_simulator"};

std::string where(const std::string& file, const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? file : fmt::format("{}:{}", file, mark.line + 1);
}

template <class T>
bool convert(const YAML::Node& entry, T& value) {
  return entry.IsScalar() && YAML::convert<T>::decode(entry, value);
}

}  // namespace

SectionReader::SectionReader(std::string file, std::string section, YAML::Node node)
    : file_(std::move(file)), section_(std::move(section)), node_(std::move(node)) {
  if (!node_.IsNull() && !node_.IsMap())
    throw ConfigurationError(
        fmt::format("{}: {}: must be a map of keys to values", where(file_, node_), section_));
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node_)
    if (!entry.first.IsScalar() || !seen.insert(entry.first.Scalar()).second)
      fail(entry.first, text(entry.first), "stands here twice or is no plain name");
}

YAML::Node SectionReader::find(const std::string& key) const {
  return node_[key];  // const: undefined where there is none
}

void SectionReader::refuse_unknown_keys() const {
  if (!node_.IsMap()) return;
  for (const auto& entry : node_)
    if (!known_.contains(entry.first.Scalar()))
      fail(entry.first, entry.first.Scalar(),
           fmt::format("unknown key; known are {}", fmt::join(known_, ", ")));
}

void SectionReader::read(const std::string& key, const YAML::Node& entry, bool& value) const {
  if (!convert(entry, value)) fail(entry, key, "must be true or false, is " + text(entry));
}

void SectionReader::read(const std::string& key, const YAML::Node& entry, int& value) const {
  if (!convert(entry, value)) fail(entry, key, "must be a whole number, is " + text(entry));
}

void SectionReader::read(const std::string& key, const YAML::Node& entry, double& value) const {
  if (!convert(entry, value) || !std::isfinite(value))
    fail(entry, key, "must be a number, is " + text(entry));
}

void SectionReader::read(const std::string& key, const YAML::Node& entry,
                         std::string& value) const {
  if (!entry.IsScalar()) fail(entry, key, "must be a text, is " + text(entry));
  value = entry.Scalar();
}

void SectionReader::read(const std::string& key, const YAML::Node& entry,
                         std::vector<double>& value) const {
  if (!entry.IsSequence()) fail(entry, key, "must be a list of numbers, is " + text(entry));
  value.clear();
  for (const auto& element : entry) read(key, element, value.emplace_back());
}

void SectionReader::read(const std::string& key, const YAML::Node& entry,
                         std::vector<std::string>& value) const {
  if (!entry.IsSequence()) fail(entry, key, "must be a list of texts, is " + text(entry));
  value.clear();
  for (const auto& element : entry) read(key, element, value.emplace_back());
}

void SectionReader::fail(const YAML::Node& at, const std::string& key,
                         const std::string& why) const {
  throw ConfigurationError(fmt::format("{}: {}.{}: {}", where(file_, at), section_, key, why));
}

std::string SectionReader::text(const YAML::Node& entry) {
  return entry.IsScalar() ? "'" + entry.Scalar() + "'" : entry.IsSequence() ? "a list" : "a map";
}

std::string SectionWriter::write(const std::string& value) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}

Configuration Configuration::from_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw ConfigurationError(path + ": cannot be read: give the cell's file with --cell");
  return from_text(text.str(), path);
}

Configuration Configuration::from_text(const std::string& text, const std::string& name) {
  Configuration configuration;
  configuration.name_ = name;
  try {
    YAML::Node root = YAML::Load(text);
    if (root.IsNull()) return configuration;
    if (!root.IsMap())
      throw ConfigurationError(name + ": must be a map of sections, for example 'extraction:'");
    for (const auto& section : root) {
      const std::string key = section.first.IsScalar() ? section.first.Scalar() : "?";
      if (!kSections.contains(key))
        throw ConfigurationError(fmt::format("{}: {}: unknown section; known are {}",
                                             where(name, section.first), key,
                                             fmt::join(kSections, ", ")));
    }
    configuration.root_ = root;
  } catch (const YAML::Exception& error) {
    throw ConfigurationError(
        fmt::format("{}:{}: not YAML: {}", name, error.mark.line + 1, error.msg));
  }
  return configuration;
}

std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char character : text)
    hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3u;
  return fmt::format("{:016x}", hash);
}

}  // namespace arcstart
