#include "services/command_line/imports/unfinished_log.hpp"

#include <fmt/core.h>

#include <filesystem>

#include "services/command_line/imports/import_error.hpp"

namespace arcstart::command_line {

namespace fs = std::filesystem;

UnfinishedLog::UnfinishedLog(const std::string& path)
    : path_(path), part_(path + ".part"), log_(part_) {}

UnfinishedLog::~UnfinishedLog() {
  std::error_code ignored;
  if (!finished_) fs::remove(part_, ignored);
}

void UnfinishedLog::finish() {
  log_.close();
  std::error_code error;
  fs::rename(part_, path_, error);
  if (error) throw ImportError(fmt::format("{}: cannot be written: {}", path_, error.message()));
  finished_ = true;
}

}  // namespace arcstart::command_line
