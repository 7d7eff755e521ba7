// SPDX-License-Identifier: BSL-1.0
#include <talus/core/column.hpp>
#include <talus/core/ids.hpp>
#include <talus/core/types.hpp>
#include <talus/dynamics/bodies.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

using talus::Column;

BOOST_AUTO_TEST_SUITE(core_column)

BOOST_AUTO_TEST_CASE(any_integer_is_an_index) {
    talus::PerBody<double> mass = {1.0, 2.0, 3.0};
    const talus::BodyIndex body = 1;
    mass[body] = 5.0;
    BOOST_CHECK_EQUAL(mass[std::size_t{1}], 5.0);
    BOOST_CHECK_EQUAL(mass[1u], 5.0);
    BOOST_CHECK_EQUAL(mass[std::int64_t{1}], 5.0);
    const auto& same = mass;
    BOOST_CHECK_EQUAL(&same[body], mass.data() + 1);
    static_assert(std::is_same_v<decltype(same[body]), const double&>);
}

BOOST_AUTO_TEST_CASE(is_a_range_a_span_and_a_vector_where_one_is_asked_for) {
    const Column<int> a(3, 7), b = {7, 7, 7};
    BOOST_CHECK(a == b);
    BOOST_CHECK(!(a == Column<int>{7, 7}) && !(a == Column<int>{7, 7, 8}));
    const std::span<const int> view = a;
    const std::vector<int> copy = a;
    const Column<int> back = copy, of_view(view);
    BOOST_CHECK(view.data() == a.data() && view.size() == 3u);
    BOOST_CHECK(back == a && of_view == a);
    BOOST_TEST(std::accumulate(a.begin(), a.end(), 0) == 21);
    static_assert(std::is_nothrow_move_constructible_v<Column<int>>);
    static_assert(std::is_nothrow_move_assignable_v<Column<std::string>>);
    static_assert(std::ranges::contiguous_range<Column<int>>);
}

/// Copied by code of its own, and yet without a destructor, as small matrices are.
struct Copied {
    int k = 0;
    Copied() = default;
    explicit Copied(int k_) : k(k_) {}
    Copied(const Copied& other) noexcept : k(other.k) {}
    Copied& operator=(const Copied& other) noexcept {
        k = other.k;
        return *this;
    }
    friend auto operator<=>(const Copied&, const Copied&) = default;
};
static_assert(!std::is_trivially_copyable_v<Copied> && std::is_trivially_destructible_v<Copied>);

/// Whatever is done at random to both, they hold the same.
template <class T, class Make>
void goes_with_a_vector(Make&& make) {
    std::mt19937 lot(3);
    Column<T> column, other;
    std::vector<T> vector, other_vector;
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(lot() % n); };
    for (int k = 0; k < 4000; ++k) {
        const T x = make(static_cast<int>(lot() % 100));
        const std::size_t n = below(30);
        const auto at = static_cast<std::ptrdiff_t>(below(vector.size() + 1));
        switch (lot() % 14) {
            case 0:
                column.resize(n);
                vector.resize(n);
                break;
            case 1:
                column.resize(n, x);
                vector.resize(n, x);
                break;
            case 2:
                column.assign(n, x);
                vector.assign(n, x);
                break;
            case 3:
                column.assign(other.begin(), other.end());
                vector.assign(other_vector.begin(), other_vector.end());
                break;
            case 4:
                column.append(other);
                vector.insert(vector.end(), other_vector.begin(), other_vector.end());
                break;
            case 5:
                column.insert(column.begin() + at, x);
                vector.insert(vector.begin() + at, x);
                break;
            case 6:
                if (!vector.empty()) {
                    column.pop_back();
                    vector.pop_back();
                }
                break;
            case 7: {
                const auto end = at + static_cast<std::ptrdiff_t>(
                                          below(vector.size() - static_cast<std::size_t>(at) + 1));
                column.erase(column.begin() + at, column.begin() + end);
                vector.erase(vector.begin() + at, vector.begin() + end);
                break;
            }
            case 8: {
                const auto gone = [&](const T& y) { return y < x; };
                BOOST_REQUIRE_EQUAL(column.erase_if(gone), std::erase_if(vector, gone));
                break;
            }
            case 9:
                column.swap(other);
                vector.swap(other_vector);
                break;
            case 10:
                other = column;
                other_vector = vector;
                break;
            case 11:
                column.reserve(n);
                BOOST_REQUIRE(column.capacity() >= n);
                break;
            default:
                column.push_back(x);
                vector.push_back(x);
        }
        BOOST_REQUIRE(std::equal(column.begin(), column.end(), vector.begin(), vector.end()));
        BOOST_REQUIRE(column.empty() == vector.empty());
        if (vector.size() > 200) {
            column.clear();
            vector.clear();
        }
    }
}
BOOST_AUTO_TEST_CASE(does_what_a_vector_does) {
    goes_with_a_vector<double>([](int k) { return 0.5 * k; });
    goes_with_a_vector<bool>([](int k) { return k % 2 == 0; });
    goes_with_a_vector<Copied>([](int k) { return Copied(k); });
    // Too long to be held without memory of its own: what is lost or freed twice is seen.
    goes_with_a_vector<std::string>([](int k) { return std::string(40, 'a') + std::to_string(k); });
    goes_with_a_vector<std::shared_ptr<int>>([](int k) {
        static std::vector<std::shared_ptr<int>> known(100);
        auto& one = known[static_cast<std::size_t>(k)];
        if (!one) one = std::make_shared<int>(k);
        return one;
    });
}

BOOST_AUTO_TEST_CASE(its_own_items_may_be_added_to_it) {
    Column<std::string> column{std::string(40, 'x')};
    for (int k = 0; k < 100; ++k) column.push_back(column.front());
    column.resize(300, column.back());
    BOOST_TEST(std::ranges::count(column, std::string(40, 'x')) == 300);
    column.assign(1000, column[7]);
    BOOST_TEST(column.size() == 1000u);
    BOOST_TEST(column.back() == std::string(40, 'x'));
    const Column<std::string>& same = column;
    column = same;
    BOOST_TEST(column.size() == 1000u);
}

BOOST_AUTO_TEST_CASE(room_is_kept_and_grows_with_what_is_in_it) {
    Column<int> column;
    int moves = 0;
    for (int k = 0; k < 100000; ++k) {
        const int* before = column.data();
        column.push_back(k);
        moves += column.data() != before ? 1 : 0;
    }
    BOOST_TEST(moves < 20);
    const int* place = column.data();
    column.clear();
    column.assign(100000, 3);
    const Column<int> shorter(10, 4);
    column = shorter;
    BOOST_CHECK(column.data() == place);
    column.resize(99999);
    BOOST_CHECK(column.data() == place);
}

BOOST_AUTO_TEST_CASE(what_throws_leaves_it_whole) {
    struct Fragile {
        std::shared_ptr<int> held = std::make_shared<int>(1);
        bool breaks = false;
        Fragile() = default;
        Fragile(Fragile&&) noexcept = default;
        Fragile& operator=(Fragile&&) noexcept = default;
        Fragile(const Fragile& o) : held(o.held), breaks(o.breaks) {
            if (breaks) throw std::runtime_error("no copy");
        }
        Fragile& operator=(const Fragile&) = default;
    };
    Column<Fragile> column(5);
    column[3].breaks = true;
    const auto held = column[1].held;
    BOOST_CHECK_THROW(Column<Fragile>{column}, std::runtime_error);
    Column<Fragile> other(2);
    BOOST_CHECK_THROW(other.append(column), std::runtime_error);
    BOOST_CHECK_THROW(column.push_back(column[3]), std::runtime_error);
    BOOST_TEST(column.size() == 5u);
    other.clear();
    BOOST_TEST(held.use_count() == 2);
    BOOST_CHECK_THROW(Column<double>(std::numeric_limits<std::size_t>::max() / 8 + 1),
                      std::bad_alloc);
}

BOOST_AUTO_TEST_CASE(items_stand_where_their_type_must) {
    struct alignas(64) Line {
        double x[3];
    };
    for (std::size_t n = 1; n < 50; ++n) {
        const Column<Line> lines(n);
        BOOST_TEST(reinterpret_cast<std::uintptr_t>(lines.data()) % 64 == 0u);
    }
    const Column<talus::Vector<2>> zero(4);
    BOOST_TEST(std::ranges::all_of(zero, [](const auto& v) { return v.is_zero(); }));
}

BOOST_AUTO_TEST_CASE(bodies_are_asked_by_their_index) {
    talus::Bodies<2> bodies;
    bodies.add_obstacle({});
    const talus::BodyIndex body = bodies.add({2.0, talus::AngularVector<2>::Constant(1.0)}, {});
    BOOST_CHECK_EQUAL(bodies.mass(body), 2.0);
    BOOST_TEST(!bodies.is_obstacle(body));
    BOOST_CHECK(bodies.pose(body).position == bodies.position[body]);
}

BOOST_AUTO_TEST_SUITE_END()
