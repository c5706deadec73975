#include "common/configuration.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace arcstart {
namespace {

// A section is a service's folder, the bus that all share, or the folder of jobs with what it held
// for recorded scans.
const std::set<std::string> kSections = {"bus",        "sensor_capture", "robot_pose",
                                         "extraction", "reconstruction", "seam_finding",
                                         "robot_link", "calibration",    "cell_simulator",
                                         "jobs",       "jobs_of_scans"};

std::string where(const std::string& file, const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? file : fmt::format("{}:{}", file, mark.line + 1);
}

template <class T>
bool convert(const YAML::Node& entry, T& value) {
  return entry.IsScalar() && YAML::convert<T>::decode(entry, value);
}

std::string text(const YAML::Node& entry) {
  return entry.IsScalar() ? "'" + entry.Scalar() + "'" : entry.IsSequence() ? "a list" : "a map";
}

}  // namespace

std::string Between::operator()(double value) const {
  return value >= low && value <= high ? "" : fmt::format("must lie between {} and {}", low, high);
}
std::string Positive::operator()(double value) const {
  return value > 0 ? "" : "must be greater than 0";
}
std::string NotNegative::operator()(double value) const {
  return value >= 0 ? "" : "must not be below 0";
}
std::string OneOf::operator()(const std::string& value) const {
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return "";
  return fmt::format("must be one of {}", fmt::join(choices, ", "));
}

SectionReader::SectionReader(std::string file, std::string section, const YAML::Node& node)
    : file_(std::move(file)),
      section_(std::move(section)),
      node_(std::make_shared<const YAML::Node>(node)) {
  if (!node_->IsNull() && !node_->IsMap())
    throw ConfigurationError(
        fmt::format("{}: {}: must be a map of keys to values", where(file_, node), section_));
  if (!node_->IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : *node_)
    if (!entry.first.IsScalar() || !seen.insert(entry.first.Scalar()).second)
      fail(entry.first, text(entry.first), "stands here twice or is no plain name");
}

YAML::Node SectionReader::find(const std::string& key) {
  known_.insert(key);
  return (*node_)[key];  // const: undefined where there is none
}

void SectionReader::refuse_unknown_keys() const {
  if (!node_->IsMap()) return;
  for (const auto& entry : *node_)
    if (!known_.contains(entry.first.Scalar()))
      fail(entry.first, entry.first.Scalar(),
           fmt::format("unknown key; known are {}", fmt::join(known_, ", ")));
}

bool SectionReader::read(const std::string& key, bool& value) {
  const YAML::Node entry = find(key);
  if (entry && !convert(entry, value)) fail(entry, key, "must be true or false, is " + text(entry));
  return entry.IsDefined();
}

bool SectionReader::read(const std::string& key, int& value) {
  const YAML::Node entry = find(key);
  if (entry && !convert(entry, value))
    fail(entry, key, "must be a whole number, is " + text(entry));
  return entry.IsDefined();
}

bool SectionReader::read(const std::string& key, double& value) {
  const YAML::Node entry = find(key);
  if (entry && (!convert(entry, value) || !std::isfinite(value)))
    fail(entry, key, "must be a number, is " + text(entry));
  return entry.IsDefined();
}

bool SectionReader::read(const std::string& key, std::string& value) {
  const YAML::Node entry = find(key);
  if (!entry) return false;
  if (!entry.IsScalar()) fail(entry, key, "must be a text, is " + text(entry));
  value = entry.Scalar();
  return true;
}

bool SectionReader::read(const std::string& key, std::vector<double>& value) {
  const YAML::Node entry = find(key);
  if (!entry) return false;
  if (!entry.IsSequence()) fail(entry, key, "must be a list of numbers, is " + text(entry));
  value.clear();
  for (const auto& element : entry)
    if (!convert(element, value.emplace_back()) || !std::isfinite(value.back()))
      fail(element, key, "must be a number, is " + text(element));
  return true;
}

bool SectionReader::read(const std::string& key, std::vector<std::string>& value) {
  const YAML::Node entry = find(key);
  if (!entry) return false;
  if (!entry.IsSequence()) fail(entry, key, "must be a list of texts, is " + text(entry));
  value.clear();
  for (const auto& element : entry) {
    if (!element.IsScalar()) fail(element, key, "must be a text, is " + text(element));
    value.push_back(element.Scalar());
  }
  return true;
}

bool SectionReader::read(const std::string& key, double* values, std::size_t count) {
  std::vector<double> numbers;
  if (!read(key, numbers)) return false;
  if (numbers.size() != count)
    fail(find(key), key, fmt::format("must be a list of {} numbers", count));
  std::copy(numbers.begin(), numbers.end(), values);
  return true;
}

void SectionReader::refuse(const std::string& key, const std::string& why) const {
  const YAML::Node entry = (*node_)[key];
  fail(entry, key, why + ", is " + text(entry));
}

void SectionReader::fail(const YAML::Node& at, const std::string& key,
                         const std::string& why) const {
  throw ConfigurationError(fmt::format("{}: {}.{}: {}", where(file_, at), section_, key, why));
}

void SectionWriter::add(const std::string& key, const std::string& value) {
  text_ += "  " + key + ": " + value + "\n";
}
std::string SectionWriter::write(bool value) { return value ? "true" : "false"; }
std::string SectionWriter::write(int value) { return fmt::format("{}", value); }
std::string SectionWriter::write(double value) { return fmt::format("{}", value); }
std::string SectionWriter::write(const std::string& value) {
  YAML::Emitter emitter;
  emitter << YAML::DoubleQuoted << value;
  return emitter.c_str();
}
std::string SectionWriter::write(const std::vector<double>& values) {
  std::string line = "[";
  for (const double value : values) line += (line.size() > 1 ? ", " : "") + write(value);
  return line + "]";
}
std::string SectionWriter::write(const std::vector<std::string>& values) {
  std::string line = "[";
  for (const std::string& value : values) line += (line.size() > 1 ? ", " : "") + write(value);
  return line + "]";
}

Configuration::Configuration() : root_(std::make_shared<YAML::Node>(YAML::NodeType::Map)) {}

bool Configuration::has(const std::string& section) const { return (*root_)[section].IsDefined(); }

SectionReader Configuration::section_reader(const std::string& section) const {
  return {name_, section, has(section) ? (*root_)[section] : YAML::Node()};
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
    configuration.root_ = std::make_shared<const YAML::Node>(root);
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
