#include "apps/stop_signal.hpp"

#include <signal.h>
#include <unistd.h>

namespace ppm {

namespace {

std::atomic<bool> stop_requested = false;
std::string_view what_follows;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not take a lock");

void tell(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

void on_signal(int) {
  stop_requested = true;
  tell("\ninterrupted: ");
  tell(what_follows);
  tell(" (again to abort)\n");
}

void handle(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);  // the next one meets the default: the end
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

StopSignal::StopSignal(std::string_view what_now) {
  what_follows = what_now;
  stop_requested = false;
  handle(SIGINT, on_signal);
  handle(SIGTERM, on_signal);
}

StopSignal::~StopSignal() {
  handle(SIGINT, SIG_DFL);
  handle(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& StopSignal::requested() const {
  return stop_requested;
}

}  // namespace ppm
