// cell.yaml: one file a cell, a section a service. A section is a plain struct with defaults and
// one member
//
//     template <class Visitor> void visit(Visitor& visitor) {
//       visitor("sigma_px", sigma_px, between(0.8, 12.0));
//     }
//
// which names its keys once, for reading and for writing. Keys carry their unit.
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "common/input_error.hpp"

namespace arcstart {

// "cell.yaml:12: extraction.sigma_px: must lie between 0.8 and 12, is -1". Programs print it and
// exit 2.
class ConfigurationError : public InputError {
 public:
  using InputError::InputError;
};

// A condition on a value: why it is impossible, empty where it is possible.
template <class T>
using Condition = std::function<std::string(const T&)>;

inline auto between(double low, double high) {
  return [low, high](const auto& value) -> std::string {
    const auto number = static_cast<double>(value);
    return number >= low && number <= high ? ""
                                           : fmt::format("must lie between {} and {}", low, high);
  };
}
inline auto positive() {
  return [](const auto& value) -> std::string { return value > 0 ? "" : "must be greater than 0"; };
}
inline auto not_negative() {
  return [](const auto& value) -> std::string { return value >= 0 ? "" : "must not be below 0"; };
}
inline auto one_of(std::vector<std::string> choices) {
  return [choices](const std::string& value) -> std::string {
    for (const auto& choice : choices)
      if (value == choice) return "";
    return fmt::format("must be one of {}", fmt::join(choices, ", "));
  };
}

// Reads one section; every key must be known, of the right type and possible.
class SectionReader {
 public:
  SectionReader(std::string file, std::string section, YAML::Node node);

  template <class T>
  void operator()(const std::string& key, T& value,
                  std::type_identity_t<Condition<T>> condition = {}) {
    known_.insert(key);
    const YAML::Node entry = find(key);
    if (!entry) return;
    read(key, entry, value);
    if (!condition) return;
    if (const std::string why = condition(value); !why.empty())
      fail(entry, key, why + ", is " + text(entry));
  }
  void refuse_unknown_keys() const;

 private:
  YAML::Node find(const std::string& key) const;
  void read(const std::string& key, const YAML::Node& entry, bool& value) const;
  void read(const std::string& key, const YAML::Node& entry, int& value) const;
  void read(const std::string& key, const YAML::Node& entry, double& value) const;  // finite
  void read(const std::string& key, const YAML::Node& entry, std::string& value) const;
  void read(const std::string& key, const YAML::Node& entry, std::vector<double>& value) const;
  void read(const std::string& key, const YAML::Node& entry, std::vector<std::string>& value) const;
  template <std::size_t N>
  void read(const std::string& key, const YAML::Node& entry, std::array<double, N>& value) const {
    std::vector<double> numbers;
    read(key, entry, numbers);
    if (numbers.size() != N) fail(entry, key, fmt::format("must be a list of {} numbers", N));
    std::copy(numbers.begin(), numbers.end(), value.begin());
  }
  [[noreturn]] void fail(const YAML::Node& at, const std::string& key,
                         const std::string& why) const;
  static std::string text(const YAML::Node& entry);

  std::string file_, section_;
  YAML::Node node_;
  std::set<std::string> known_;
};

// Writes one section with every key, so that reading it again gives the same values bit by bit.
class SectionWriter {
 public:
  explicit SectionWriter(const std::string& section) : text_(section + ":\n") {}
  template <class T>
  void operator()(const std::string& key, const T& value,
                  const std::type_identity_t<Condition<T>>& = {}) {
    text_ += "  " + key + ": " + write(value) + "\n";
  }
  const std::string& text() const { return text_; }

 private:
  static std::string write(bool value) { return value ? "true" : "false"; }
  static std::string write(int value) { return fmt::format("{}", value); }
  static std::string write(double value) { return fmt::format("{}", value); }
  static std::string write(const std::string& value);
  template <class List>
  static std::string write(const List& values) {
    std::string line = "[";
    for (const auto& value : values) line += (line.size() > 1 ? ", " : "") + write(value);
    return line + "]";
  }
  std::string text_;
};

class Configuration {
 public:
  Configuration() = default;                                // all defaults
  static Configuration from_file(const std::string& path);  // throws ConfigurationError
  static Configuration from_text(const std::string& text,
                                 const std::string& name);  // name stands in errors

  bool has(const std::string& section) const { return root_[section].IsDefined(); }

  template <class Settings>
  Settings read(const std::string& section) const {
    Settings settings;
    SectionReader reader(name_, section, has(section) ? root_[section] : YAML::Node());
    settings.visit(reader);
    reader.refuse_unknown_keys();
    return settings;
  }
  const std::string& name() const { return name_; }

 private:
  std::string name_ = "defaults";
  YAML::Node root_{YAML::NodeType::Map};
};

// The section's effective text, every key with its value.
template <class Settings>
std::string write_settings(const std::string& section, Settings settings) {
  SectionWriter writer(section);
  settings.visit(writer);
  return writer.text();
}

// 64-bit FNV-1a of a text, 16 hexadecimal digits: names a configuration or a calibration, guards
// nothing.
std::string fingerprint(const std::string& text);

}  // namespace arcstart
