#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "reports/results.h"

namespace volumark {
namespace {

[[noreturn]] void give_up(const std::filesystem::path& file, const std::string& temporary, const char* what) {
  const int error = errno;
  if (!temporary.empty()) ::unlink(temporary.c_str());
  throw ResultsError(file.string() + ": " + what + ": " + std::strerror(error) + "; the file is as it was before");
}

}  // namespace

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  const std::string temporary = file.string() + ".tmp" + std::to_string(::getpid());
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) give_up(file, "", "cannot be created");
  size_t done = 0;
  while (done < content.size()) {
    const ssize_t n = ::write(fd, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      ::close(fd);
      give_up(file, temporary, "cannot be written");
    }
    done += static_cast<size_t>(n);
  }
  if (::fsync(fd) != 0 && errno != EINVAL) {  // EINVAL: a file system without sync
    ::close(fd);
    give_up(file, temporary, "cannot be written");
  }
  if (::close(fd) != 0) give_up(file, temporary, "cannot be written");
  if (::rename(temporary.c_str(), file.c_str()) != 0) give_up(file, temporary, "cannot be renamed into place");
}

}  // namespace volumark
