#include "services/command_line/recordings/answer_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "common/input_error.hpp"

namespace arcstart::command_line {

void write_answers(const std::string& path, const std::vector<ReplayedSeam>& seams) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  for (const ReplayedSeam& seam : seams) {
    const auto size = static_cast<std::uint32_t>(seam.bytes.size());
    for (int shift = 0; shift < 32; shift += 8)
      file.put(static_cast<char>(static_cast<unsigned char>(size >> shift)));
    file.write(reinterpret_cast<const char*>(seam.bytes.data()), size);
  }
  // A full disk shows only when what is buffered is written.
  file.close();
  if (!file)
    throw InputError(path + ": cannot be written" +
                     (errno != 0 ? std::string(": ") + std::strerror(errno) : ""));
}

}  // namespace arcstart::command_line
