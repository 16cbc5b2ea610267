#include "framework/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace ppm {

namespace {

/// What a loop's bodies share.
struct Loop {
  const std::function<void(std::size_t, int)>& body;
  /// What oneTBB orders anyway (the caller before the bodies, the bodies before the return), said once more where
  /// ThreadSanitizer sees it: the library's own code is not instrumented.
  std::atomic<int> order{0};
};

/// A loop's body as oneTBB copies it from task to task. Under ThreadSanitizer copies are ordered too: the writing of one
/// before its use by whichever thread.
class LoopBody {
 public:
  explicit LoopBody(Loop& loop) : loop_(&loop) { published(); }
  LoopBody(const LoopBody& other) : loop_(other.loop()) { published(); }
  LoopBody& operator=(const LoopBody&) = delete;

  void operator()(const tbb::blocked_range<std::size_t>& range) const {
    Loop& loop = *this->loop();
    loop.order.load(std::memory_order_acquire);
    const int worker = tbb::this_task_arena::current_thread_index();
    for (std::size_t i = range.begin(); i != range.end(); ++i) loop.body(i, worker);
    loop.order.fetch_add(1, std::memory_order_release);
  }

 private:
#ifdef __SANITIZE_THREAD__
  static inline std::atomic<int> copies_{0};
  static void published() { copies_.fetch_add(1, std::memory_order_release); }
  Loop* loop() const {
    copies_.load(std::memory_order_acquire);
    return loop_;
  }
#else
  static void published() {}
  Loop* loop() const { return loop_; }
#endif
  Loop* loop_;
};

}  // namespace

struct Workers::Arena {
  explicit Arena(int threads)
      : allow(tbb::global_control::max_allowed_parallelism,
              static_cast<std::size_t>(std::max(threads, tbb::info::default_concurrency()))),
        arena(threads) {}
  tbb::global_control allow;  // oneTBB starts no more threads than cores unless told to: N means N
  tbb::task_arena arena;
};

Workers::Workers(int threads)
    : threads_(threads > 0 ? threads : tbb::info::default_concurrency()), arena_(std::make_unique<Arena>(threads_)) {}

Workers::~Workers() = default;

void Workers::for_each(std::size_t n, const std::function<void(std::size_t, int)>& body) const {
  if (n == 0) return;
  using Range = tbb::blocked_range<std::size_t>;
  const std::size_t grain = std::max<std::size_t>(1, n / (static_cast<std::size_t>(threads_) * 32));
  Loop loop{body};
  loop.order.store(1, std::memory_order_release);
  arena_->arena.execute([&] {
    // Isolated: a worker that waits for an inner loop must not start another item of the outer one, whose scratch it
    // holds.
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(Range(0, n, grain), LoopBody(loop), tbb::simple_partitioner{}); });
  });
  loop.order.load(std::memory_order_acquire);
}

}  // namespace ppm
