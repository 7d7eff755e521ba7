// SPDX-License-Identifier: BSL-1.0
// A periodic cell by itself: what is none, how it deforms, the lattice by its shortest vectors.
#include <talus/dynamics/periodic_cell.hpp>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "common/dimensions.hpp"
#include "common/random_geometry.hpp"
#include "common/said.hpp"

BOOST_AUTO_TEST_SUITE(dynamics_periodic_cell)

template <int Dim>
talus::Matrix<Dim> random_matrix(random_geometry::Generator& g, double size) {
    talus::Matrix<Dim> m;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j) m(i, j) = random_geometry::uniform(g, -size, size);
    return m;
}

BOOST_AUTO_TEST_CASE_TEMPLATE(inverse_and_exponential_are_those_of_the_matrix, D, dimensions) {
    constexpr int Dim = D::value;
    using M = talus::Matrix<Dim>;
    random_geometry::Generator g(1);
    for (int k = 0; k < 100; ++k) {
        const M m = random_matrix<Dim>(g, 2.0);
        const auto [inverse, determinant] = talus::inverted(m);
        BOOST_TEST((inverse * m - M::Identity()).norm() < 1e-10 * (1.0 + inverse.norm()));
        const M other = random_matrix<Dim>(g, 2.0);
        BOOST_TEST(std::abs(talus::inverted(M(m * other)).determinant -
                            determinant * talus::inverted(other).determinant) < 1e-11);
        // exp(m) exp(-m) = 1, and det exp(m) = exp(trace m).
        const M there = M::Identity() + talus::exponential_less_one(m);
        const M back = M::Identity() + talus::exponential_less_one(M(-m));
        BOOST_TEST((there * back - M::Identity()).norm() < 1e-12 * there.norm() * back.norm());
        BOOST_TEST(std::abs(talus::inverted(there).determinant / std::exp(m.trace()) - 1.0) <
                   1e-11);
    }
    M shear = M::Zero();
    shear(0, 1) = 0.3;
    BOOST_TEST((talus::exponential_less_one(shear) == shear));
    BOOST_TEST((talus::exponential_less_one(M(M::Zero())) == M::Zero()));
    BOOST_TEST(talus::inverted(M(M::Ones())).determinant == 0.0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_cell_deforms_by_its_velocity_gradient, D, dimensions) {
    constexpr int Dim = D::value;
    using M = talus::Matrix<Dim>;
    auto cell = talus::PeriodicCell<Dim>::box(2.0 * talus::Vector<Dim>::Ones());
    const auto before = cell;
    cell.advance(1.0);
    BOOST_TEST((cell == before));
    cell.set_velocity_gradient(-0.1 * M::Identity());
    for (int k = 0; k < 1000; ++k) cell.advance(1e-3);
    BOOST_TEST((cell.lattice() - std::exp(-0.1) * before.lattice()).norm() < 1e-13);
    BOOST_CHECK_CLOSE(cell.volume(), std::pow(2.0 * std::exp(-0.1), Dim), 1e-10);
    M shear = M::Zero();
    shear(0, 1) = 0.5;
    auto sheared = before;
    sheared.set_velocity_gradient(shear);
    sheared.advance(3.0);
    M expected = before.lattice();
    expected(0, 1) = 3.0;
    BOOST_TEST((sheared.lattice() - expected).norm() < 1e-14);
    const auto again = talus::from_record<talus::PeriodicCell<Dim>>(talus::record_of(sheared));
    BOOST_TEST((again == sheared));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_lattice_is_known_by_its_shortest_vectors, D, dimensions) {
    constexpr int Dim = D::value;
    random_geometry::Generator g(2);
    for (int k = 0; k < 200; ++k) {
        talus::Matrix<Dim> lattice = random_matrix<Dim>(g, 1.0);
        if (std::abs(talus::inverted(lattice).determinant) < 0.05) continue;
        // The true shortest vector, of a lattice that is not sheared much.
        double least = std::numeric_limits<double>::infinity();
        const int far = 12;
        for (int a = -far; a <= far; ++a)
            for (int b = -far; b <= far; ++b)
                for (int c = Dim == 3 ? -far : 0; c <= (Dim == 3 ? far : 0); ++c) {
                    if (a == 0 && b == 0 && c == 0) continue;
                    talus::Vector<Dim> v = a * talus::Vector<Dim>(lattice.col(0)) +
                                           b * talus::Vector<Dim>(lattice.col(1));
                    v += c * talus::Vector<Dim>(lattice.col(Dim - 1));
                    if (v.norm() > 0.0) least = std::min(least, v.norm());
                }
        auto all = talus::PeriodicCell<Dim>::all_directions();
        BOOST_CHECK_CLOSE((talus::ReducedLattice<Dim>{lattice, all}).shortest(), least, 1e-9);
        // The same one, sheared by whole vectors a thousand times.
        talus::Matrix<Dim> sheared = lattice;
        sheared.col(1) += 1000.0 * lattice.col(0);
        sheared.col(0) += 7.0 * sheared.col(Dim - 1);
        const talus::ReducedLattice<Dim> reduced(sheared, all);
        BOOST_CHECK_CLOSE(reduced.shortest(), least, 1e-6);
        BOOST_CHECK_CLOSE(std::abs(talus::inverted(reduced.vectors).determinant),
                          std::abs(talus::inverted(lattice).determinant), 1e-5);
    }
    // What is not periodic stays as it is.
    talus::Matrix<Dim> lattice = talus::Matrix<Dim>::Identity();
    lattice(0, 1) = 10.25;
    talus::ReducedLattice<Dim> one(lattice, {true, false});
    BOOST_TEST((one.vectors == lattice));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(places_are_wrapped_into_the_cell, D, dimensions) {
    constexpr int Dim = D::value;
    talus::Matrix<Dim> lattice = 2.0 * talus::Matrix<Dim>::Identity();
    lattice(0, 1) = 0.5;
    const talus::PeriodicCell<Dim> cell(lattice);
    random_geometry::Generator g(3);
    for (int k = 0; k < 100; ++k) {
        const talus::Vector<Dim> x = random_geometry::displacement<Dim>(g, 0.0, 50.0);
        const talus::Vector<Dim> s = talus::inverted(lattice).inverse * cell.wrapped(x);
        const talus::Vector<Dim> way = talus::inverted(lattice).inverse * (x - cell.wrapped(x));
        for (int d = 0; d < Dim; ++d) {
            BOOST_TEST((s[d] > -1e-12 && s[d] < 1.0 + 1e-12));
            BOOST_TEST(std::abs(way[d] - std::round(way[d])) < 1e-12);
        }
    }
    talus::ImageShift image;
    image.n = {1, -2, 0};
    BOOST_TEST((cell.offset(image)[0] == 1.0 && cell.offset(image)[1] == -4.0));
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_no_cell_is_refused, D, dimensions) {
    constexpr int Dim = D::value;
    using M = talus::Matrix<Dim>;
    using Cell = talus::PeriodicCell<Dim>;
    M left = M::Identity();
    left(0, 0) = -1.0;
    BOOST_TEST(said([&] { Cell{left}; }) ==
               "volume of the cell over the product of its sides is -1, but must be at least "
               "1e-06: lattice vectors right-handed, and not all but parallel");
    BOOST_CHECK_THROW(Cell{M(M::Ones())}, talus::input_error);
    M none = M::Identity();
    none(1, 1) = 0.0;
    BOOST_TEST(said([&] { Cell{none}; }) ==
               "length of the cell's lattice vector 1 is 0, but must be finite and positive");
    M bad = M::Identity();
    bad(0, 1) = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK_THROW(Cell{bad}, talus::input_error);
    BOOST_CHECK_THROW(Cell(M::Identity(), bad), talus::input_error);
    BOOST_CHECK_THROW(Cell::box(-talus::Vector<Dim>::Ones()), talus::input_error);
    Cell cell{M(M::Identity())};
    BOOST_CHECK_THROW(cell.set_velocity_gradient(bad), talus::input_error);
    BOOST_CHECK_THROW(cell.set_lattice(left), talus::input_error);
    BOOST_TEST((cell == Cell{M(M::Identity())}));
}

BOOST_AUTO_TEST_SUITE_END()
