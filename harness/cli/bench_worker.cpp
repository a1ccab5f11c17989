#include "harness/cli/bench_worker.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace volumark::cli {
namespace {

struct Reply {
  BenchFrame frame;
  char error[240];  // empty: the frame is good
};

bool read_all(int fd, void* data, size_t size) {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t n = ::read(fd, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    size -= static_cast<size_t>(n);
  }
  return true;
}

bool write_all(int fd, const void* data, size_t size) {
  return ::write(fd, data, size) == static_cast<ssize_t>(size);  // small enough for a pipe to take at once
}

// What a request byte asks for. The end of the pipe is no signal: processes forked later hold it open too.
constexpr char kFrame = 1, kQuit = 0;

void serve(const BenchSetup& setup, int requests, int replies) {
  std::function<BenchFrame()> frame;
  for (char request = kQuit; read_all(requests, &request, 1) && request != kQuit;) {
    Reply reply{};
    try {
      if (!frame) frame = setup();
      reply.frame = frame();
    } catch (const std::exception& error) {
      std::strncpy(reply.error, error.what(), sizeof reply.error - 1);
    }
    if (!write_all(replies, &reply, sizeof reply)) return;
  }
}

}  // namespace

BenchWorker::~BenchWorker() {
  if (pid_ < 0) return;
  write_all(to_child_, &kQuit, 1);
  ::close(to_child_);
  ::close(from_child_);
  ::waitpid(pid_, nullptr, 0);
}

void BenchWorker::start(const BenchSetup& setup, int threads) {
  int requests[2], replies[2];
  if (::pipe2(requests, O_CLOEXEC) != 0) throw std::runtime_error("no pipe for a benchmark's process");
  if (::pipe2(replies, O_CLOEXEC) != 0) throw std::runtime_error("no pipe for a benchmark's process");
  std::fflush(nullptr);
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no process for a benchmark");
  if (pid_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::close(requests[1]);
    ::close(replies[0]);
    // 0 is the caller's thread alone, for llvmpipe and lavapipe.
    ::setenv("LP_NUM_THREADS", threads == 1 ? "0" : std::to_string(threads).c_str(), 1);
    serve(setup, requests[0], replies[1]);
    std::_Exit(0);
  }
  ::close(requests[0]);
  ::close(replies[1]);
  to_child_ = requests[1];
  from_child_ = replies[0];
}

BenchFrame BenchWorker::frame(const BenchSetup& setup, int threads) {
  if (pid_ < 0) start(setup, threads);
  Reply reply{};
  if (!write_all(to_child_, &kFrame, 1) || !read_all(from_child_, &reply, sizeof reply))
    throw std::runtime_error("the benchmark's process died");
  if (reply.error[0] != '\0') throw std::runtime_error(reply.error);
  return reply.frame;
}

}  // namespace volumark::cli
