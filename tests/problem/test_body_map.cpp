// SPDX-License-Identifier: BSL-1.0
#include <talus/law/coulomb.hpp>
#include <talus/problem/body_map.hpp>

#include <Eigen/Cholesky>

#include "common/delassus_tester.hpp"
#include "common/dimensions.hpp"
#include "common/random_problem.hpp"

BOOST_AUTO_TEST_SUITE(body_map)

/// B, written out.
template <int Dim>
Eigen::MatrixXd dense(const talus::BodyMap<Dim>& map) {
    Eigen::MatrixXd b =
        Eigen::MatrixXd::Zero(map.rows(), static_cast<Eigen::Index>(Dim * map.contact_count()));
    for (std::size_t c = 0; c < map.contact_count(); ++c)
        for (const auto& e : map.entries(c)) {
            const auto block = map.block(e);
            b.block(map.offset(e.body), static_cast<Eigen::Index>(Dim * c), block.rows(), Dim) +=
                block;
        }
    return b;
}

template <int Dim>
Eigen::MatrixXd dense(const talus::DelassusSparse<Dim>& w) {
    const auto n = static_cast<Eigen::Index>(Dim * w.contact_count());
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i < w.contact_count(); ++i)
        for (std::size_t k = 0; k < w.columns(i).size(); ++k)
            m.block<Dim, Dim>(static_cast<Eigen::Index>(Dim * i),
                              static_cast<Eigen::Index>(Dim * w.columns(i)[k])) = w.blocks(i)[k];
    return m;
}

/// B^T B = W, and both products with B are those of the matrix.
template <int Dim>
void check_map(const talus::BodyMap<Dim>& map, const Eigen::MatrixXd& w, RandomBlocks& random) {
    const Eigen::MatrixXd b = dense(map);
    BOOST_REQUIRE(b.cols() == w.cols());
    BOOST_TEST((b.transpose() * b - w).norm() <= 1e-13 * w.norm());
    Eigen::VectorXd r(b.cols()), v, u;
    for (double& x : r) x = random.uniform(-1.0, 1.0);
    map.to_bodies(r, v);
    BOOST_TEST((v - b * r).norm() <= 1e-13 * b.norm() * r.norm());
    map.to_contacts(v, u);
    BOOST_TEST((u - b.transpose() * v).norm() <= 1e-13 * b.norm() * v.norm());
}

template <int Dim>
talus::ContactProblem<Dim, talus::Coulomb<Dim>> problem(RandomBlocks& random, int bodies,
                                                        int contacts) {
    return RandomProblem<Dim, talus::Coulomb<Dim>>{
        .bodies = bodies, .contacts = contacts, .mass_ratio = 1e4}
        .make(random, {0.5});
}

/// A random system of `sizes` generalised coordinates per body, each contact between two of them.
template <int Dim>
struct MatrixForm {
    Eigen::SparseMatrix<double> mass, contact_map;

    MatrixForm(RandomBlocks& random, const std::vector<int>& sizes, int contacts) {
        std::vector<int> offset(1, 0);
        for (const int s : sizes) offset.push_back(offset.back() + s);
        std::vector<Eigen::Triplet<double>> m, h;
        for (std::size_t k = 0; k < sizes.size(); ++k) {
            Eigen::MatrixXd g(sizes[k], sizes[k]);
            for (double& x : g.reshaped()) x = random.uniform(-1.0, 1.0);
            const Eigen::MatrixXd own =
                g * g.transpose() + 0.1 * Eigen::MatrixXd::Identity(sizes[k], sizes[k]);
            for (int i = 0; i < sizes[k]; ++i)
                for (int j = 0; j < sizes[k]; ++j)
                    m.emplace_back(offset[k] + i, offset[k] + j, own(i, j));
        }
        for (int c = 0; c < contacts; ++c)
            for (int side = 0; side < 2; ++side) {
                const auto k =
                    static_cast<std::size_t>(random.integer(0, static_cast<int>(sizes.size()) - 1));
                for (int i = 0; i < sizes[k]; ++i)
                    for (int d = 0; d < Dim; ++d)
                        h.emplace_back(offset[k] + i, Dim * c + d, random.uniform(-1.0, 1.0));
            }
        mass.resize(offset.back(), offset.back());
        mass.setFromTriplets(m.begin(), m.end());
        contact_map.resize(offset.back(), Dim * contacts);
        contact_map.setFromTriplets(h.begin(), h.end());
    }
    Eigen::MatrixXd delassus() const {
        const Eigen::MatrixXd h = contact_map;
        return h.transpose() * Eigen::MatrixXd(mass).ldlt().solve(h);
    }
    /// Numbers the coordinates otherwise, so that a body's are not side by side.
    void shuffle(RandomBlocks& random) {
        Eigen::PermutationMatrix<Eigen::Dynamic> p(mass.rows());
        p.setIdentity();
        for (Eigen::Index i = mass.rows() - 1; i > 0; --i)
            std::swap(p.indices()[i], p.indices()[random.integer(0, static_cast<int>(i))]);
        mass = mass.twistedBy(p);
        contact_map = p * contact_map;
    }
};

BOOST_AUTO_TEST_CASE_TEMPLATE(square_of_the_map_is_the_delassus_matrix, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(121);
    for (int k = 0; k < 20; ++k) {
        const auto p = problem<dim>(random, random.integer(2, 10), random.integer(1, 20));
        const talus::BodyMap<dim> map(p.jacobian, p.inverse_mass);
        check_map<dim>(map, dense(talus::DelassusSparse<dim>(p.jacobian, p.inverse_mass)), random);
        // The obstacle has no rows.
        BOOST_TEST(map.body_sizes().size() == p.inverse_mass.body_count() - 1);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_driven_cell_has_a_row_for_each_component, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(123);
    for (int k = 0; k < 10; ++k) {
        const auto p =
            RandomProblem<dim, talus::Coulomb<dim>>{
                .bodies = 4 + k, .contacts = 3 + 2 * k, .guided = k % 2 == 1, .driven = true}
                .make(random, {0.5});
        const talus::BodyMap<dim> map(p.jacobian, p.inverse_mass);
        check_map<dim>(map, dense_delassus<dim>(p.jacobian, p.inverse_mass), random);
        BOOST_TEST(map.body_sizes().back() == dim * dim - 1);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(what_cannot_move_has_no_rows, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(122);
    auto p = problem<dim>(random, 6, 12);
    auto& m = p.inverse_mass;
    m.angular[0].setZero();  // a particle
    m.linear[1] = 0.0;       // turns on a pivot
    m.linear[2] = 0.0;       // an obstacle
    m.angular[2].setZero();
    m.angular[3].setZero();  // turns about one axis only
    m.angular[3](0, 0) = 2.0;
    m.free_axes.assign(6, talus::Vector<dim>::Ones());
    m.free_axes[4][0] = 0.0;  // on a rail
    const talus::BodyMap<dim> map(p.jacobian, m);
    const int turns = talus::rotation_dof<dim>;
    const std::vector<int> expected{dim, turns, dim + 1, dim - 1 + turns};
    BOOST_TEST(std::vector<int>(map.body_sizes().begin(), map.body_sizes().end()) == expected,
               boost::test_tools::per_element());
    check_map<dim>(map, dense_delassus<dim>(p.jacobian, m), random);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(contact_of_obstacles_and_of_a_body_with_itself_are_borne, D,
                              dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(123);
    auto p = problem<dim>(random, 4, 6);
    p.inverse_mass.linear[2] = 0.0;
    p.inverse_mass.angular[2].setZero();
    p.jacobian.a[1] = 2;
    p.jacobian.b[1] = 3;
    p.jacobian.a[4] = p.jacobian.b[4] = 0;
    const talus::BodyMap<dim> map(p.jacobian, p.inverse_mass);
    BOOST_TEST(map.entries(1).empty());
    check_map<dim>(map, dense_delassus<dim>(p.jacobian, p.inverse_mass), random);
    check_map<dim>(map, dense(talus::DelassusSparse<dim>(p.jacobian, p.inverse_mass)), random);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(factors_scale_the_contacts, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(124);
    const auto p = problem<dim>(random, 5, 7);
    talus::BodyMap<dim> map(p.jacobian, p.inverse_mass);
    Eigen::MatrixXd w = dense_delassus<dim>(p.jacobian, p.inverse_mass);
    std::vector<double> factor;
    for (Eigen::Index c = 0; c < 7; ++c) {
        factor.push_back(random.log_uniform(0.01, 100.0));
        w.middleRows<dim>(dim * c) *= factor.back();
        w.middleCols<dim>(dim * c) *= factor.back();
    }
    map.scale(factor);
    check_map<dim>(map, w, random);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(block_diagonal_mass_gives_a_map_in_any_numbering, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(125);
    for (int k = 0; k < 10; ++k) {
        MatrixForm<dim> form(random, {6, 3, 1, 6, 12}, 8);
        if (k % 2 == 1) form.shuffle(random);
        talus::BodyMap<dim> map;
        BOOST_REQUIRE(map.assign(form.mass, form.contact_map));
        BOOST_TEST(map.body_sizes().size() == 5u);
        check_map<dim>(map, form.delassus(), random);
    }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(coupled_or_bad_mass_is_refused_and_leaves_an_empty_map, D,
                              dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(126);
    talus::BodyMap<dim> map;
    MatrixForm<dim> good(random, {6, 6}, 3);
    BOOST_REQUIRE(map.assign(good.mass, good.contact_map));
    MatrixForm<dim> coupled(random, {3, 13}, 4);
    BOOST_TEST(!map.assign(coupled.mass, coupled.contact_map));
    BOOST_TEST(map.rows() == 0);
    BOOST_TEST(map.contact_count() == 0u);
    MatrixForm<dim> indefinite(random, {6, 6}, 3);
    indefinite.mass.coeffRef(7, 7) = -1.0;
    BOOST_TEST(!map.assign(indefinite.mass, indefinite.contact_map));
    BOOST_TEST(map.rows() == 0);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(global_operator_offers_bodies_where_there_are_some, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(127);
    for (const bool falls_apart : {true, false}) {
        const MatrixForm<dim> form(
            random, falls_apart ? std::vector<int>{6, 3, 6} : std::vector<int>{6, 20}, 7);
        const Eigen::MatrixXd w = form.delassus();
        std::vector<talus::DelassusBlock<dim>> blocks;
        for (std::size_t i = 0; i < 7; ++i)
            for (std::size_t j = 0; j < 7; ++j)
                blocks.push_back({i, j,
                                  w.block<dim, dim>(static_cast<Eigen::Index>(dim * i),
                                                    static_cast<Eigen::Index>(dim * j))});
        talus::DelassusGlobal<dim> global({7, blocks}, form.mass, form.contact_map);
        BOOST_REQUIRE((global.bodies() != nullptr) == falls_apart);
        test_delassus<dim>(global, w, random);
        if (falls_apart) check_map<dim>(*global.bodies(), w, random);
    }
}

BOOST_AUTO_TEST_CASE(empty_map_has_nothing) {
    const talus::BodyMap<2> never;
    BOOST_TEST(never.rows() == 0);
    BOOST_TEST(never.contact_count() == 0u);
    const talus::BodyMap<3> none(talus::ContactJacobian<3>{}, talus::InverseMass<3>{});
    BOOST_TEST(none.rows() == 0);
    BOOST_TEST(none.contact_count() == 0u);
}

BOOST_AUTO_TEST_SUITE_END()
