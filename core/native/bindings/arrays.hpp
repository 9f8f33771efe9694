// Type casters: NumPy arrays to the spans that kernels take, and `OwnedArray` to NumPy arrays.
//
// An array must have the span's type and width and be contiguous; it is never copied. Anything else is a TypeError that
// says what is expected. Arrays that a kernel writes must be writable.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>

#if defined(__linux__)
#include <cxxabi.h>
#include <unistd.h>
#endif

#include "energy/objective_norm.hpp"
#include "mesh/array_views.hpp"

namespace nanobind::detail {

// Numbers of a row of an array.
template <class T> struct RowOf {
    using Number = T;
    static constexpr std::size_t width = 1;
};
template <class T, std::size_t n> struct RowOf<std::array<T, n>> {
    using Number = T;
    static constexpr std::size_t width = n;
};

template <class T> struct type_caster<std::span<T>> {
    using Row = RowOf<std::remove_const_t<T>>;
    using Number = std::conditional_t<std::is_const_v<T>, const typename Row::Number, typename Row::Number>;
    static constexpr std::size_t width = Row::width;
    using Array = ndarray<Number, c_contig, device::cpu>;
    // Vectors at the eight corners of each hex are (m, 8, 3) in Python.
    using Shaped =
        std::conditional_t<width == 1, ndarray<Number, ndim<1>, c_contig, device::cpu>,
                           std::conditional_t<width == 24, ndarray<Number, shape<-1, 8, 3>, c_contig, device::cpu>,
                                              ndarray<Number, shape<-1, (ssize_t)width>, c_contig, device::cpu>>>;

    NB_TYPE_CASTER(std::span<T>, make_caster<Shaped>::Name)

    bool from_python(handle source, uint8_t flags, cleanup_list *cleanup) noexcept {
        if (!array_.from_python(source, flags & ~(uint8_t)cast_flags::convert, cleanup)) return false;
        const Array &array = array_.value;
        std::size_t numbers = 1;
        for (std::size_t k = 1; k < array.ndim(); ++k) numbers *= array.shape(k);
        if (array.ndim() == 0 || numbers != width) return false;
        value = std::span<T>(reinterpret_cast<T *>(array.data()), array.shape(0));
        return true;
    }

  private:
    make_caster<Array> array_;
};

// (p, offset)
template <> struct type_caster<hexmend::ObjectiveNorm> {
    using Numbers = std::pair<double, double>;
    NB_TYPE_CASTER(hexmend::ObjectiveNorm, make_caster<Numbers>::Name)

    bool from_python(handle source, uint8_t flags, cleanup_list *cleanup) noexcept {
        make_caster<Numbers> numbers;
        if (!numbers.from_python(source, flags, cleanup)) return false;
        auto [p, offset] = static_cast<Numbers>(numbers);
        value = {p, offset};
        return true;
    }
};

template <class T, std::size_t width> struct type_caster<hexmend::OwnedArray<T, width>> {
    using Array =
        std::conditional_t<width == 1, ndarray<numpy, T, ndim<1>>, ndarray<numpy, T, shape<-1, (ssize_t)width>>>;

    using Arrays = hexmend::OwnedArray<T, width>;
    NB_TYPE_CASTER(Arrays, make_caster<Array>::Name)

    static handle from_cpp(hexmend::OwnedArray<T, width> &&made, rv_policy, cleanup_list *cleanup) noexcept {
        using Values = decltype(made.values);
        auto *kept = new Values(std::move(made.values));
        capsule owner(kept, [](void *p) noexcept { delete static_cast<Values *>(p); });
        std::size_t shape[2] = {kept->size() / width, width};
        auto *data = reinterpret_cast<T *>(kept->data());
        return make_caster<Array>::from_cpp(Array(data, width == 1 ? 1 : 2, shape, owner), rv_policy::reference,
                                            cleanup);
    }
};

}  // namespace nanobind::detail

namespace hexmend {

namespace nb = nanobind;
using namespace nb::literals;

// Releases the interpreter's lock (GIL) during its lifetime.
//
// A thread that returns from a kernel during the interpreter's shutdown does not get the lock back: Python before 3.14
// ends it by pthread_exit, whose unwinding would abort the process. Here it sleeps until the process ends, as in 3.14.
class GilRelease {
  public:
    GilRelease() : state_(PyEval_SaveThread()) {}
    GilRelease(const GilRelease &) = delete;
    GilRelease &operator=(const GilRelease &) = delete;
#if defined(__GLIBCXX__) && defined(__linux__)
    ~GilRelease() {
        try {
            PyEval_RestoreThread(state_);
        } catch (abi::__forced_unwind &) {
            for (;;) pause();
        }
    }
#else
    ~GilRelease() { PyEval_RestoreThread(state_); }
#endif

  private:
    PyThreadState *state_;
};

// Constructor of a view of arrays, which it keeps alive: its members are the arguments. `check` of the view, if it has
// one, throws where they do not fit each other.
template <class... Members> struct ViewOf : nb::def_visitor<ViewOf<Members...>> {
    template <class Class, class... Extra> void execute(Class &cl, const Extra &...extra) {
        using View = typename Class::Type;
        auto make = [](View *self, Members... members) {
            View view{members...};
            if constexpr (requires { view.check(); }) view.check();
            new (self) View(view);
        };
        [&]<std::size_t... i>(std::index_sequence<i...>) {
            cl.def("__init__", make, extra..., nb::keep_alive<1, i + 2>()...);
        }(std::index_sequence_for<Members...>());
    }
};

// Kernels run without the GIL, so that the window stays responsive.
using ReleaseGil = nb::call_guard<GilRelease>;

}  // namespace hexmend
