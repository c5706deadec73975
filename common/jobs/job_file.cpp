#include "common/jobs/job_file.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace arcstart {

std::string job_name_error(const std::string& name) {
  const auto is_plain = [](unsigned char c) { return c < 128 && std::isalnum(c); };
  bool plain = !name.empty() && name.size() <= 64 && is_plain(name.front());
  for (const char c : name) plain &= is_plain(c) || c == '-' || c == '_' || c == '.';
  return plain
             ? ""
             : "a job's name is of letters, digits, '-', '_' and '.', at most 64, and begins with "
               "a letter or digit";
}

std::string job_path(const Configuration& cell, const std::string& name) {
  const std::filesystem::path folder = cell.read<JobsSettings>("jobs").folder;
  // operator/ gives an absolute folder as it is.
  return std::filesystem::path(cell.name()).parent_path() / folder / (name + ".yaml");
}

JobFile JobFile::from_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw ConfigurationError(path + ": cannot be read: is the job's name right?");
  return from_text(text.str(), path);
}

JobFile JobFile::from_text(const std::string& text, const std::string& name) {
  JobFile job;
  job.name_ = name;
  try {
    YAML::Node root = YAML::Load(text);
    if (root.IsNull()) root = YAML::Node(YAML::NodeType::Map);
    if (!root.IsMap())
      throw ConfigurationError(name + ": must be a map of sections, for example 'seam_finding:'");
    for (const auto& section : root) {
      const std::string key = section.first.IsScalar() ? section.first.Scalar() : "?";
      if (key != "seam_finding" && key != "job")
        throw ConfigurationError(
            fmt::format("{}:{}: {}: unknown section; known are job, seam_finding", name,
                        section.first.Mark().line + 1, key));
    }
    job.root_ = std::make_shared<const YAML::Node>(root);
  } catch (const YAML::Exception& error) {
    throw ConfigurationError(
        fmt::format("{}:{}: not YAML: {}", name, error.mark.line + 1, error.msg));
  }
  return job;
}

SectionReader JobFile::section_reader(const std::string& section) const {
  const YAML::Node node = (*root_)[section];
  return {name_, section, node.IsDefined() ? node : YAML::Node()};
}

}  // namespace arcstart
