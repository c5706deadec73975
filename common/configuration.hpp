// cell.yaml: one file a cell, a section a service. A section is a plain struct with defaults and
// one member
//
//     template <class Visitor> void visit(Visitor& visitor) {
//       visitor("sigma_px", sigma_px, between(0.8, 12.0));
//     }
//
// which names its keys once, for reading and for writing. Keys carry their unit.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "common/input_error.hpp"

// Nearly everything includes this: yaml-cpp and fmt stay in configuration.cpp.
namespace YAML {
class Node;
}  // namespace YAML

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

struct Between {
  double low, high;
  std::string operator()(double value) const;
};
struct Positive {
  std::string operator()(double value) const;
};
struct NotNegative {
  std::string operator()(double value) const;
};
struct OneOf {
  std::vector<std::string> choices;
  std::string operator()(const std::string& value) const;
};
inline Between between(double low, double high) { return {low, high}; }
inline Positive positive() { return {}; }
inline NotNegative not_negative() { return {}; }
inline OneOf one_of(std::vector<std::string> choices) { return {std::move(choices)}; }

struct Names {
  std::vector<std::string> all;
};

// Reads one section; every key must be known, of the right type and possible.
class SectionReader {
 public:
  SectionReader(std::string file, std::string section, const YAML::Node& node);

  template <class T>
  void operator()(const std::string& key, T& value,
                  const std::type_identity_t<Condition<T>>& condition = {}) {
    if (!read(key, value) || !condition) return;
    if (const std::string why = condition(value); !why.empty()) refuse(key, why);
  }
  // One of an enumeration's values, by its name; names: of all its values, in their order.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const std::string& key, Enum& value, const Names& names) {
    std::string name = names.all[static_cast<std::size_t>(value)];
    (*this)(key, name, one_of(names.all));
    value =
        static_cast<Enum>(std::find(names.all.begin(), names.all.end(), name) - names.all.begin());
  }
  void refuse_unknown_keys() const;

 private:
  // False where the section has no such key.
  bool read(const std::string& key, bool& value);
  bool read(const std::string& key, int& value);
  bool read(const std::string& key, double& value);  // finite
  bool read(const std::string& key, std::string& value);
  bool read(const std::string& key, std::vector<double>& value);
  bool read(const std::string& key, std::vector<std::string>& value);
  bool read(const std::string& key, double* values, std::size_t count);
  template <std::size_t N>
  bool read(const std::string& key, std::array<double, N>& value) {
    return read(key, value.data(), N);
  }
  YAML::Node find(const std::string& key);
  [[noreturn]] void refuse(const std::string& key, const std::string& why) const;
  [[noreturn]] void fail(const YAML::Node& at, const std::string& key,
                         const std::string& why) const;

  std::string file_, section_;
  std::shared_ptr<const YAML::Node> node_;
  std::set<std::string> known_;
};

// Writes one section with every key, so that reading it again gives the same values bit by bit.
class SectionWriter {
 public:
  explicit SectionWriter(const std::string& section) : text_(section + ":\n") {}
  template <class T>
  void operator()(const std::string& key, const T& value,
                  const std::type_identity_t<Condition<T>>& = {}) {
    add(key, write(value));
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const std::string& key, const Enum& value, const Names& names) {
    add(key, write(names.all[static_cast<std::size_t>(value)]));
  }
  const std::string& text() const { return text_; }

 private:
  void add(const std::string& key, const std::string& value);
  static std::string write(bool value);
  static std::string write(int value);
  static std::string write(double value);
  static std::string write(const std::string& value);
  static std::string write(const std::vector<double>& values);
  static std::string write(const std::vector<std::string>& values);
  template <std::size_t N>
  static std::string write(const std::array<double, N>& values) {
    return write(std::vector<double>(values.begin(), values.end()));
  }
  std::string text_;
};

class Configuration {
 public:
  Configuration();                                          // all defaults
  static Configuration from_file(const std::string& path);  // throws ConfigurationError
  static Configuration from_text(const std::string& text,
                                 const std::string& name);  // name stands in errors

  bool has(const std::string& section) const;

  template <class Settings>
  Settings read(const std::string& section) const {
    Settings settings;
    SectionReader reader = section_reader(section);
    settings.visit(reader);
    reader.refuse_unknown_keys();
    return settings;
  }
  const std::string& name() const { return name_; }

 private:
  SectionReader section_reader(const std::string& section) const;

  std::string name_ = "defaults";
  std::shared_ptr<const YAML::Node> root_;
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
