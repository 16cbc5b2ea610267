#pragma once
#include <array>
#include <chrono>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace ppm::test {

/// A child process whose output is collected.
class Process {
 public:
  /// argv[0] is the program's path.
  explicit Process(std::vector<std::string> argv) {
    int out_pipe[2], err_pipe[2];
    if (::pipe2(out_pipe, O_CLOEXEC) != 0 || ::pipe2(err_pipe, O_CLOEXEC) != 0) throw std::runtime_error("pipe failed");
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, out_pipe[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, err_pipe[1], STDERR_FILENO);
    std::vector<char*> args;
    for (auto& a : argv) args.push_back(a.data());
    args.push_back(nullptr);
    const int error = ::posix_spawn(&pid_, args[0], &actions, nullptr, args.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(out_pipe[1]);
    ::close(err_pipe[1]);
    fds_ = {out_pipe[0], err_pipe[0]};
    if (error != 0) throw std::runtime_error("cannot start " + argv[0]);
  }
  ~Process() {
    if (pid_ > 0 && !waited_) {
      ::kill(pid_, SIGKILL);
      wait();
    }
    for (int fd : fds_) ::close(fd);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int number) const { ::kill(pid_, number); }
  /// Reads until the child ends.
  void wait() {
    std::array<pollfd, 2> polls{pollfd{fds_[0], POLLIN, 0}, pollfd{fds_[1], POLLIN, 0}};
    for (int open = 2; open > 0;) {
      ::poll(polls.data(), polls.size(), -1);
      for (std::size_t i = 0; i < 2; ++i) {
        if (polls[i].fd < 0 || !polls[i].revents) continue;
        char buffer[4096];
        const auto n = ::read(polls[i].fd, buffer, sizeof buffer);
        if (n > 0) {
          (i == 0 ? out : err).append(buffer, static_cast<std::size_t>(n));
        } else {
          polls[i].fd = -1;
          --open;
        }
      }
    }
    int status = 0;
    ::waitpid(pid_, &status, 0);
    waited_ = true;
    code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

  std::string out, err;  ///< what the child wrote; complete after wait()
  int code = -1;         ///< exit code, or -1 where a signal ended it
  int signal = 0;

 private:
  pid_t pid_ = -1;
  std::array<int, 2> fds_{-1, -1};
  bool waited_ = false;
};

}  // namespace ppm::test
