// Parallel loops.
//
// Every thread that calls kernels has its own helper threads, created at its first parallel loop and with its priority;
// idle helpers sleep. Pieces of a loop are assigned dynamically. A loop therefore writes disjoint rows, and sums over
// rows are taken afterwards, in order: results do not depend on the number of threads.
#pragma once

#include <cstdint>

namespace hexmend {

// Number of threads, at least 1, that run a loop of the calling thread; set_threads sets it for that thread.
int threads();
void set_threads(int count);

// Set the number for threads that have not set one.
void set_default_threads(int count);

namespace detail {
void share(std::int64_t pieces, void (*body)(const void *, std::int64_t), const void *context);
}

// Call body(i) for i = 0 to pieces - 1, in parallel and in any order.
template <class Body> void parallel(std::int64_t pieces, const Body &body) {
    detail::share(pieces, [](const void *b, std::int64_t i) { (*static_cast<const Body *>(b))(i); }, &body);
}

// Call body(begin, end) in parallel for chunks of at most `size` of the numbers 0 to count - 1.
template <class Body> void parallel_chunks(std::int64_t count, std::int64_t size, const Body &body) {
    parallel((count + size - 1) / size, [&](std::int64_t i) {
        std::int64_t end = (i + 1) * size;
        body(i * size, end < count ? end : count);
    });
}

// Call body(i) in parallel for i = 0 to count - 1; a thread takes `size` of them at a time.
template <class Body> void parallel_for(std::int64_t count, std::int64_t size, const Body &body) {
    parallel_chunks(count, size, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) body(i);
    });
}

}  // namespace hexmend
