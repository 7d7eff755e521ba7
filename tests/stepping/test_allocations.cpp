// SPDX-License-Identifier: BSL-1.0
// A steady step allocates nothing. Counts every operator new of this program.
#include <boost/test/unit_test.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

#include "common/dimensions.hpp"
#include "heap.hpp"

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t bytes, std::size_t alignment) {
    ++allocations;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* p = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
    if (p == nullptr) throw std::bad_alloc();
    return p;
}
}  // namespace

[[gnu::noinline]] void* operator new(std::size_t n) {
    return counted(n, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t n, std::align_val_t a) {
    return counted(n, static_cast<std::size_t>(a));
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
    std::free(p);
}

BOOST_AUTO_TEST_SUITE(stepping_allocations)

using namespace experiment;

BOOST_AUTO_TEST_CASE(the_counter_counts) {
    const long before = allocations;
    delete new int(3);
    BOOST_CHECK_GT(allocations.load(), before);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_steady_step_allocates_nothing, D, dimensions) {
    constexpr int Dim = D::value;
    for (auto scheme : {talus::Scheme::midpoint, talus::Scheme::gap_anticipating}) {
        talus::SimulationParams params;
        params.step.scheme = scheme;
        params.gap_correction.fraction = 0.1;
        auto sim = heap<Dim>(Dim == 2 ? 6 : 3, 5, law<Dim>(0.4), 2e-3, params);
        sim.run(2.0);
        const long before = allocations;
        sim.run(0.1);
        BOOST_CHECK_EQUAL(allocations.load() - before, 0);
        BOOST_CHECK_GT(sim.data().contact_count(), 20u);
    }
}

BOOST_AUTO_TEST_SUITE_END()
