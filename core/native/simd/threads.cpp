#include "simd/threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace hexmend {
namespace {

// Larger numbers of threads are mistakes.
constexpr int MAX_THREADS = 1024;

// Polls of an atomic before a thread sleeps: about ten microseconds.
constexpr int SPINS = 400;

// Tell the processor that the thread polls.
void cpu_relax() {
#if defined(__x86_64__)
    _mm_pause();
#else
    std::this_thread::yield();
#endif
}

// Wait while `number` equals `old`: poll first, then sleep.
void wait_while_equal(const std::atomic<std::uint32_t> &number, std::uint32_t old) {
    for (int i = 0; i < SPINS; ++i) {
        if (number.load(std::memory_order_acquire) != old) return;
        cpu_relax();
    }
    number.wait(old, std::memory_order_acquire);
}

// True while this thread runs a parallel loop; loops nested in it are sequential.
thread_local bool in_shared_loop = false;

// The helper threads of one calling thread.
class ThreadTeam {
  public:
    explicit ThreadTeam(int wanted) : wanted_(wanted) {
        helpers_.reserve(wanted);
        try {
            for (int i = 0; i < wanted; ++i) helpers_.emplace_back([this] { help(); });
        } catch (const std::exception &) {  // the system gives no more threads: go on with those that exist
        }
    }

    ~ThreadTeam() {
        stopping_ = true;
        call();
        for (auto &helper : helpers_) helper.join();
    }

    int wanted() const { return wanted_; }

    // Run body(context, i) for all pieces i, on this thread and the helpers.
    void share(std::int64_t pieces, void (*body)(const void *, std::int64_t), const void *context) {
        body_ = body, context_ = context, pieces_ = pieces;
        next_.store(0, std::memory_order_relaxed);
        gate_.store(OPEN, std::memory_order_release);
        call();
        work();
        // Close the gate instead of waiting for helpers that have not started: on a busy machine that may take long.
        gate_.fetch_and(~OPEN, std::memory_order_acq_rel);
        for (std::uint32_t inside; (inside = gate_.load(std::memory_order_acquire)) != 0;)
            wait_while_equal(gate_, inside);
        if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    }

  private:
    void call() {
        generation_.fetch_add(1, std::memory_order_release);
        generation_.notify_all();
    }

    void work() {
        try {
            for (std::int64_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < pieces_;) body_(context_, i);
        } catch (...) {
            std::lock_guard lock(guard_);
            error_ = std::current_exception();
        }
    }

    bool enter() {
        std::uint32_t gate = gate_.load(std::memory_order_relaxed);
        while (gate & OPEN)
            if (gate_.compare_exchange_weak(gate, gate + 1, std::memory_order_acq_rel)) return true;
        return false;
    }

    void help() {
        in_shared_loop = true;
        for (std::uint32_t turn = 0;;) {
            wait_while_equal(generation_, turn);
            turn = generation_.load(std::memory_order_acquire);
            if (stopping_) return;
            if (!enter()) continue;
            work();
            if (gate_.fetch_sub(1, std::memory_order_acq_rel) == 1) gate_.notify_all();
        }
    }

    static constexpr std::uint32_t OPEN = 1u << 31;

    int wanted_;
    std::vector<std::thread> helpers_;
    std::atomic<std::uint32_t> generation_{0};
    std::atomic<std::uint32_t> gate_{0};  // bit OPEN: helpers may join the loop; other bits: helpers inside
    std::atomic<std::int64_t> next_{0};
    std::int64_t pieces_ = 0;
    void (*body_)(const void *, std::int64_t) = nullptr;
    const void *context_ = nullptr;
    std::atomic<bool> stopping_{false};
    std::mutex guard_;
    std::exception_ptr error_;
};

long process_id() {
#if defined(__unix__) || defined(__APPLE__)
    return static_cast<long>(getpid());
#else
    return 0;
#endif
}

std::atomic<int> default_count{1};

struct ThreadState {
    int count = 0;  // of threads; 0: the default
    long process = 0;
    std::unique_ptr<ThreadTeam> team;

    ~ThreadState() {
#if defined(_WIN32)
        (void)team.release();  // Windows deadlocks if a thread that ends joins others
#else
        forget();
#endif
    }

    void forget() {
        // A forked process has the memory of its parent's helpers, but not the threads.
        if (team && process != process_id()) (void)team.release();
    }
};

thread_local ThreadState own;

}  // namespace

int threads() { return own.count ? own.count : default_count.load(); }

void set_threads(int count) { own.count = std::clamp(count, 1, MAX_THREADS); }

void set_default_threads(int count) { default_count = std::clamp(count, 1, MAX_THREADS); }

void detail::share(std::int64_t pieces, void (*body)(const void *, std::int64_t), const void *context) {
    int helpers = threads() - 1;
    if (pieces <= 1 || helpers == 0 || in_shared_loop) {
        for (std::int64_t i = 0; i < pieces; ++i) body(context, i);
        return;
    }
    own.forget();
    if (!own.team || own.team->wanted() != helpers) {
        own.team.reset();
        own.team = std::make_unique<ThreadTeam>(helpers);
        own.process = process_id();
    }
    in_shared_loop = true;
    struct Done {
        ~Done() { in_shared_loop = false; }
    } done;
    own.team->share(pieces, body, context);
}

}  // namespace hexmend
