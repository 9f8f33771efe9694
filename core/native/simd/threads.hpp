// Loops that threads share.
//
// Every thread that calls kernels has helpers of its own, made when it first needs them and of its own priority; while
// they wait they sleep. Who takes which piece of a loop is left to chance, so a loop writes disjoint rows, and what is
// summed over them is summed afterwards, in order: results do not depend on the number of threads.
#pragma once

#include <cstdint>

namespace hexmend {

// How many threads share a loop that the calling thread runs; at least 1.
int threads();
void set_threads(int count);

// The number for threads that have not set one.
void set_default_threads(int count);

namespace detail {
void share(std::int64_t pieces, void (*body)(const void *, std::int64_t), const void *context);
}

// body(i) for every piece i of `pieces`, in any order, at the same time.
template <class Body> void parallel(std::int64_t pieces, const Body &body) {
    detail::share(pieces, [](const void *b, std::int64_t i) { (*static_cast<const Body *>(b))(i); }, &body);
}

// body(begin, end) for chunks of at most `size` of the numbers below count.
template <class Body> void parallel_chunks(std::int64_t count, std::int64_t size, const Body &body) {
    parallel((count + size - 1) / size, [&](std::int64_t i) {
        std::int64_t end = (i + 1) * size;
        body(i * size, end < count ? end : count);
    });
}

}  // namespace hexmend
