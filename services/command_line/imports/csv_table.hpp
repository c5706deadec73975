// Tables of numbers, separated by commas, whose errors name file and line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace arcstart::command_line {

struct CsvRow {
  int line = 0;                     // of the file, from 1
  std::vector<std::string> fields;  // without the spaces around them
};

struct CsvTable {
  std::string path;
  CsvRow header;  // the first row where its first field begins with a letter; else no fields
  std::vector<CsvRow> rows;

  std::string where(const CsvRow& row) const;  // "poses.csv:7"
};

// Empty lines and those that begin with # are left out. what_it_holds stands in the error of a
// missing file. Throws ImportError: missing, without a row, separated by something else.
CsvTable read_csv(const std::string& path, const std::string& what_it_holds);

// The row must have so many fields. Throws ImportError.
void require_fields(const CsvTable& table, const CsvRow& row, std::size_t count,
                    const std::string& columns);

// A finite number. Throws ImportError.
double number_at(const CsvTable& table, const CsvRow& row, std::size_t column);

// us since 1970, UTC, between 2001 and 9999. Throws ImportError, and says so where it looks like
// s, ms or ns.
std::int64_t utime_at(const CsvTable& table, const CsvRow& row, std::size_t column);

}  // namespace arcstart::command_line
