// SPDX-License-Identifier: BSL-1.0
#include <talus/io/problem_file.hpp>
#include <talus/law/signorini.hpp>
#include <talus/problem/delassus_product.hpp>
#include <talus/problem/residual.hpp>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/dimensions.hpp"
#include "common/random_problem.hpp"
#include "io/hdf5_surgery.hpp"
#include "io/temporary_folder.hpp"

using talus::Coulomb;
using talus::MatrixStorage;
using talus::ProblemContent;
using talus::Vector;

BOOST_AUTO_TEST_SUITE(io_problem_file)

constexpr std::array all_storages{MatrixStorage::triplets, MatrixStorage::compressed_columns,
                                  MatrixStorage::compressed_rows};

template <int Dim>
using Rigid = RandomProblem<Dim, Coulomb<Dim>>;

template <int Dim>
std::vector<Vector<Dim>> random_vectors(RandomBlocks& random, std::size_t count) {
    std::vector<Vector<Dim>> r(count);
    for (auto& x : r) x = random.normal<Dim>();
    return r;
}

/// A local problem whose W is neither symmetric nor full.
template <int Dim>
ProblemContent<Dim> random_local(unsigned seed) {
    RandomBlocks random(seed);
    constexpr std::size_t contacts = 4;
    std::vector<talus::DelassusBlock<Dim>> blocks;
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 2}, {2, 0}, {3, 1}})
        blocks.push_back(
            {static_cast<std::size_t>(i), static_cast<std::size_t>(j), random.normal<Dim, Dim>()});
    ProblemContent<Dim> content;
    content.local.emplace();
    content.local->delassus = talus::DelassusSparse<Dim>(contacts, blocks);
    content.local->free_velocity = random_vectors<Dim>(random, contacts);
    for (std::size_t c = 0; c < contacts; ++c)
        content.local->laws.push_back({0.25 * static_cast<double>(c)});
    content.info = {"a title", "two\nlines", ""};
    content.solution =
        talus::solution_of<Dim>(*content.local, random_vectors<Dim>(random, contacts));
    return content;
}

template <int Dim>
ProblemContent<Dim> random_global(unsigned seed) {
    RandomBlocks random(seed);
    ProblemContent<Dim> content;
    content.global = talus::global_form(Rigid<Dim>{}.make(random, {0.4}));
    for (double& f : content.global->force) f = random.uniform(-1.0, 1.0);
    const std::size_t contacts = content.global->contact_count();
    for (int k = 0; k < 2; ++k)
        content.guesses.push_back(
            talus::solution_of<Dim>(*content.global, random_vectors<Dim>(random, contacts)));
    return content;
}

template <int Dim>
void check_same(const std::vector<Vector<Dim>>& a, const std::vector<Vector<Dim>>& b) {
    BOOST_REQUIRE(a.size() == b.size());
    for (std::size_t c = 0; c < a.size(); ++c) BOOST_TEST((a[c] == b[c]));
}

template <int Dim>
void check_same(const talus::ProblemSolution<Dim>& a, const talus::ProblemSolution<Dim>& b) {
    BOOST_REQUIRE(a.velocity.size() == b.velocity.size());
    BOOST_TEST((a.velocity == b.velocity));
    check_same<Dim>(a.relative_velocity, b.relative_velocity);
    check_same<Dim>(a.impulse, b.impulse);
}

/// What goes through a file keeps its bits.
template <int Dim>
void check_same(const ProblemContent<Dim>& a, const ProblemContent<Dim>& b) {
    BOOST_REQUIRE(a.local.has_value() == b.local.has_value());
    BOOST_REQUIRE(a.global.has_value() == b.global.has_value());
    if (a.local) {
        const Eigen::MatrixXd w = talus::detail::sparse_matrix(a.local->delassus);
        BOOST_TEST((w == Eigen::MatrixXd(talus::detail::sparse_matrix(b.local->delassus))));
        check_same<Dim>(a.local->free_velocity, b.local->free_velocity);
        for (std::size_t c = 0; c < a.local->laws.size(); ++c)
            BOOST_TEST(a.local->laws[c].mu == b.local->laws[c].mu);
    }
    if (a.global) {
        BOOST_TEST((Eigen::MatrixXd(a.global->mass) == Eigen::MatrixXd(b.global->mass)));
        BOOST_TEST(
            (Eigen::MatrixXd(a.global->contact_map) == Eigen::MatrixXd(b.global->contact_map)));
        BOOST_TEST((a.global->force == b.global->force));
        check_same<Dim>(a.global->velocity_offset, b.global->velocity_offset);
        for (std::size_t c = 0; c < a.global->laws.size(); ++c)
            BOOST_TEST(a.global->laws[c].mu == b.global->laws[c].mu);
    }
    BOOST_TEST(a.info.title == b.info.title);
    BOOST_TEST(a.info.description == b.info.description);
    BOOST_TEST(a.info.math_info == b.info.math_info);
    BOOST_REQUIRE(a.solution.has_value() == b.solution.has_value());
    if (a.solution) check_same<Dim>(*a.solution, *b.solution);
    BOOST_REQUIRE(a.guesses.size() == b.guesses.size());
    for (std::size_t k = 0; k < a.guesses.size(); ++k) check_same<Dim>(a.guesses[k], b.guesses[k]);
}

/// The complaint about a file, or nothing.
template <int Dim>
std::string complaint(const std::filesystem::path& path) {
    try {
        talus::read_problem<Dim>(path);
    } catch (const talus::input_error& error) {
        return error.what();
    }
    return {};
}

/// Files to be damaged one way each.
struct Damage {
    TemporaryFolder folder{"problem"};
    std::filesystem::path path = folder / "a.hdf5";

    /// Writes a sound local or global file, lets `cut` at it, and demands exactly the complaint.
    template <class Cut>
    void local(const std::string& expected, Cut cut) const {
        talus::write_problem(path, random_local<3>(1), MatrixStorage::compressed_rows);
        check(expected, cut);
    }
    template <class Cut>
    void global(const std::string& expected, Cut cut) const {
        talus::write_problem(path, random_global<3>(1), MatrixStorage::triplets);
        check(expected, cut);
    }

  private:
    template <class Cut>
    void check(const std::string& expected, Cut cut) const {
        BOOST_TEST(complaint<3>(path) == "");
        cut(path);
        BOOST_TEST(complaint<3>(path) == path.string() + ": " + expected);
    }
};

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

BOOST_AUTO_TEST_CASE_TEMPLATE(what_is_written_is_read_back_in_every_storage, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("problem");
    const auto path = folder / "a.hdf5";
    for (unsigned seed = 1; seed <= 3; ++seed)
        for (const auto storage : all_storages) {
            auto both = random_local<Dim>(seed);
            both.global = random_global<Dim>(seed).global;
            both.solution.reset();
            // As many contacts in both forms.
            both.local = talus::assembled(*both.global);
            for (const auto& content : {random_local<Dim>(seed), random_global<Dim>(seed), both}) {
                talus::write_problem(path, content, storage);
                BOOST_TEST(talus::problem_dimension(path) == Dim);
                check_same<Dim>(talus::read_problem<Dim>(path), content);
            }
        }
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_problem_without_contacts_is_one, D, dimensions) {
    constexpr int Dim = D::value;
    const TemporaryFolder folder("problem");
    const auto path = folder / "a.hdf5";
    talus::write_problem(path, talus::AssembledProblem<Dim, Coulomb<Dim>>{});
    BOOST_TEST(talus::read_problem<Dim>(path).local->contact_count() == 0u);
    talus::write_problem(path, talus::ContactProblem<Dim, Coulomb<Dim>>{});
    BOOST_TEST(talus::read_problem<Dim>(path).global->contact_count() == 0u);
}

BOOST_AUTO_TEST_CASE(the_same_problem_gives_the_same_bytes) {
    const TemporaryFolder folder("problem");
    talus::write_problem(folder / "a.hdf5", random_global<3>(1));
    talus::write_problem(folder / "b.hdf5", random_global<3>(1));
    BOOST_TEST((content_of(folder / "a.hdf5") == content_of(folder / "b.hdf5")));
}

BOOST_AUTO_TEST_CASE(entries_of_equal_place_are_summed) {
    const Damage damage;
    auto content = random_global<2>(1);
    talus::write_problem(damage.path, content, MatrixStorage::triplets);
    const auto name = [](const char* item) { return std::string("fclib_global/M/") + item; };
    const int size = static_cast<int>(content.global->mass.rows());
    // The diagonal twice, by halves, and a part beyond it.
    std::vector<int> index;
    std::vector<double> half;
    for (int k = 0; k < 2 * size; ++k) {
        index.push_back(k % size);
        half.push_back(0.5 * (1.0 + k % size));
    }
    for (const char* item : {"i", "p"}) Hdf5Surgery(damage.path).replace(name(item), index);
    Hdf5Surgery(damage.path).replace(name("x"), half);
    for (const char* item : {"nz", "nzmax"})
        Hdf5Surgery(damage.path).replace(name(item), std::vector{2 * size});
    const auto again = talus::read_problem<2>(damage.path);
    for (int k = 0; k < size; ++k) BOOST_TEST(again.global->mass.coeff(k, k) == 1.0 + k);
    BOOST_TEST(again.global->mass.nonZeros() == size);
}

BOOST_AUTO_TEST_CASE(room_for_more_entries_than_there_are_is_accepted) {
    const Damage damage;
    const auto content = random_local<3>(1);
    talus::write_problem(damage.path, content, MatrixStorage::compressed_rows);
    Hdf5Surgery file(damage.path);
    auto x = file.numbers("fclib_local/W/x");
    std::vector<int> i = file.integers("fclib_local/W/i");
    file.replace("fclib_local/W/nzmax", std::vector{static_cast<int>(x.size()) + 5});
    check_same<3>(talus::read_problem<3>(damage.path), content);
    x.resize(x.size() + 5);
    i.resize(i.size() + 5, 99);
    file.replace("fclib_local/W/x", x);
    file.replace("fclib_local/W/i", i);
    check_same<3>(talus::read_problem<3>(damage.path), content);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_problem_of_rigid_bodies_stays_the_same_problem, D, dimensions) {
    constexpr int Dim = D::value;
    const double rounding = 1e-12;  // of numbers of order one, some ten operations deep
    const TemporaryFolder folder("problem");
    const auto path = folder / "a.hdf5";
    RandomBlocks random(3);
    for (const bool scalar : {false, true}) {
        using Law = talus::WeightedMean<Dim, Coulomb<Dim>>;
        RandomProblem<Dim, Law> maker{.scalar_inertia = scalar};
        auto problem = maker.make(random, Law{{0.3}, 0.5, 0.0});
        problem.inverse_mass.angular[1].setZero();  // a point that does not turn
        talus::write_problem(path, problem, {"rigid", "", ""});
        const auto again = talus::read_problem<Dim>(path);
        BOOST_TEST(again.info.title == "rigid");
        const auto local = talus::assembled(again);
        const auto r = random_vectors<Dim>(random, problem.contact_count());
        std::vector<Vector<Dim>> expected(r.size());
        talus::DelassusProduct<Dim>(problem.jacobian, problem.inverse_mass).multiply(r, expected);
        const auto solution = talus::solution_of<Dim>(local, r);
        for (std::size_t c = 0; c < r.size(); ++c) {
            BOOST_TEST(local.laws[c].mu == 0.3);
            BOOST_TEST(
                (solution.relative_velocity[c] - expected[c] - problem.free_velocity[c]).norm() <
                rounding);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_law_that_is_not_coulombs_is_refused_by_its_contact) {
    using Law = talus::AnyLaw<3, talus::WeightedMean<3, Coulomb<3>>, talus::Signorini<3>>;
    const TemporaryFolder folder("problem");
    RandomBlocks random(3);
    auto problem = RandomProblem<3, Law>{}.make(random, Law{});
    talus::write_problem(folder / "a.hdf5", problem);
    problem.laws[2].law = talus::Signorini<3>{};
    BOOST_CHECK_EXCEPTION(
        talus::write_problem(folder / "b.hdf5", problem), talus::input_error, [](const auto& e) {
            return std::string(e.what()) == "law of contact 2 is another, but must be Coulomb's";
        });
    BOOST_TEST(folder.file_count() == 1);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_read_back_is_not_written) {
    const TemporaryFolder folder("problem");
    const auto path = folder / "a.hdf5";
    const auto check = [&](const auto& content, const std::string& expected) {
        BOOST_CHECK_EXCEPTION(talus::write_problem(path, content), talus::input_error,
                              [&](const auto& e) {
                                  BOOST_TEST(e.what() == path.string() + ": " + expected);
                                  return true;
                              });
    };
    check(ProblemContent<3>{}, "number of problems is 0, but must be at least 1");
    auto local = random_local<3>(1);
    local.local->free_velocity[1][2] = not_a_number;
    check(local, "fclib_local/vectors/q[5] is nan, but must be finite");
    local = random_local<3>(1);
    local.local->laws.pop_back();
    check(local, "length of fclib_local/vectors/mu is 3, but must be 4");
    local = random_local<3>(1);
    local.local->laws[3].mu = -1.0;
    check(local, "fclib_local/vectors/mu[3] is -1, but must be finite and not negative");
    local = random_local<3>(1);
    local.solution->impulse.clear();
    check(local, "length of solution/r is 0, but must be 4");
    auto global = random_global<3>(1);
    global.global->force.conservativeResize(3);
    check(global,
          "fclib_global/M/m is " + std::to_string(global.global->mass.rows()) + ", but must be 3");
    BOOST_TEST(folder.file_count() == 0);
    BOOST_CHECK_THROW(talus::write_problem(folder / "missing/a.hdf5", random_local<3>(1)),
                      std::runtime_error);
}

BOOST_AUTO_TEST_CASE(a_file_that_is_none_is_refused_and_nothing_is_printed) {
    const Damage damage;
    const auto& path = damage.path;
    const auto refused = [&](const std::string& expected) {
        BOOST_TEST(complaint<3>(path) == path.string() + ": " + expected);
        BOOST_CHECK_THROW(talus::problem_dimension(path), talus::input_error);
    };
    refused("the file cannot be read, but must be a problem file");
    talus::write_file(path, "pile 1\n");
    refused("the file is no whole HDF5 file, but must be a problem file");
    talus::write_problem(path, random_local<3>(1));
    const std::string whole = content_of(path);
    for (std::size_t part = 0; part < 64; ++part) {
        talus::write_file(path, whole.substr(0, whole.size() * part / 64));
        refused("the file is no whole HDF5 file, but must be a problem file");
    }
}

BOOST_AUTO_TEST_CASE(wrong_sizes_and_indices_are_named) {
    const Damage damage;
    const auto set = [](const char* name, auto... values) {
        return [=](const auto& path) { Hdf5Surgery(path).replace(name, std::vector{values...}); };
    };
    const auto set_one = [](const char* name, std::size_t k, auto value) {
        return [=](const auto& path) { Hdf5Surgery(path).replace_one(name, k, value); };
    };
    const auto drop = [](const char* name) {
        return [=](const auto& path) { Hdf5Surgery(path).remove(name); };
    };
    damage.local("fclib_local and fclib_global are missing, but one must be there",
                 drop("fclib_local"));
    damage.local("fclib_local/spacedim is 4, but must be in [2, 3]",
                 set("fclib_local/spacedim", 4));
    damage.local("fclib_local/spacedim is 2, but must be 3 here", set("fclib_local/spacedim", 2));
    damage.local("fclib_local/spacedim is missing, but must be there",
                 drop("fclib_local/spacedim"));
    damage.local("fclib_local/spacedim is no list of integers, but must be one",
                 set("fclib_local/spacedim", 3.0));
    damage.local("fclib_local/spacedim has length 2, but must have length 1",
                 set("fclib_local/spacedim", 3, 3));
    damage.local("fclib_local/vectors/mu[2] is -0.5, but must be finite and not negative",
                 set_one("fclib_local/vectors/mu", 2, -0.5));
    damage.local("fclib_local/vectors/mu[0] is nan, but must be finite",
                 set_one("fclib_local/vectors/mu", 0, not_a_number));
    damage.local("fclib_local/vectors/q has length 12, but must have length 6",
                 set("fclib_local/vectors/mu", 0.1, 0.2));
    damage.local("fclib_local/vectors/q[7] is inf, but must be finite",
                 set_one("fclib_local/vectors/q", 7, std::numeric_limits<double>::infinity()));
    damage.local("fclib_local/vectors/mu is no list of real numbers, but must be one",
                 set("fclib_local/vectors/mu", 1, 1, 1, 1));
    damage.local("fclib_local/W/m is 11, but must be 12 here", set("fclib_local/W/m", 11));
    damage.local("fclib_local/W/n is -3, but must be in [0, 2147483647]",
                 set("fclib_local/W/n", -3));
    damage.local("fclib_local/W/nz is -3, but must be in [-2, 2147483647]",
                 set("fclib_local/W/nz", -3));
    damage.local("fclib_local/W/p[0] is 1, but must be 0", set_one("fclib_local/W/p", 0, 1));
    damage.local("fclib_local/W/p[3] is 5, but must be at least 12",
                 set_one("fclib_local/W/p", 3, 5));
    damage.local("fclib_local/W/p is missing, but must be there", drop("fclib_local/W/p"));
    damage.local("fclib_local/W/nzmax is 62, but must be at least the number of entries, 63",
                 set("fclib_local/W/nzmax", 62));
    damage.local("fclib_local/W/i[4] is 12, but must be in [0, 12)",
                 set_one("fclib_local/W/i", 4, 12));
    damage.local("fclib_local/W/i[62] is -1, but must be in [0, 12)",
                 set_one("fclib_local/W/i", 62, -1));
    damage.local("fclib_local/W/x has length 1, but must have length 63",
                 set("fclib_local/W/x", 1.0));
    damage.local("fclib_local/W/x[8] is nan, but must be finite",
                 set_one("fclib_local/W/x", 8, not_a_number));
    damage.local("fclib_local/info/title is no text, but must be one",
                 set("fclib_local/info/title", 1));
    damage.local("solution/r is missing, but must be there", drop("solution/r"));
    damage.local(
        "fclib_local/V is there, but must not be, since bilateral constraints are not read",
        set("fclib_local/V/nz", 0));
    damage.global(
        "fclib_global/G is there, but must not be, since bilateral constraints are not read",
        set("fclib_global/G/nz", 0));
    damage.global(
        "fclib_global/vectors/b is there, but must not be, since bilateral constraints "
        "are not read",
        set("fclib_global/vectors/b", 0.0));
    damage.global("fclib_global/M/m is 30, but must be 1 here", set("fclib_global/vectors/f", 1.0));
    damage.global("fclib_global/H/p[3] is 24, but must be in [0, 24)",
                  set_one("fclib_global/H/p", 3, 24));
    damage.global("fclib_global/H/i[3] is 30, but must be in [0, 30)",
                  set_one("fclib_global/H/i", 3, 30));
    damage.global("fclib_global/H/p has length 2, but must have length 288",
                  set("fclib_global/H/p", 1, 1));
    damage.global("guesses/number_of_guesses is -1, but must be in [0, 2147483647]",
                  set("guesses/number_of_guesses", -1));
    damage.global("guesses/3/v is missing, but must be there", set("guesses/number_of_guesses", 3));
    damage.global("guesses/2/u has length 1, but must have length 24", set("guesses/2/u", 0.0));
}

BOOST_AUTO_TEST_CASE(a_length_without_numbers_behind_it_costs_no_memory) {
    const Damage damage;
    damage.local(
        "fclib_local/vectors/mu was never written, but must be whole", [](const auto& path) {
            Hdf5Surgery(path).replace_by_claim("fclib_local/vectors/mu", 1'000'000'000'000);
        });
    damage.local("fclib_local/vectors/mu is cut off, but must be whole", [](const auto& path) {
        // The file holds the length of mu, and the most it may grow to, as two numbers of 8 bytes.
        std::string bytes = content_of(path);
        const std::string length{4, 0, 0, 0, 0, 0, 0, 0}, larger{4, 0, 0, 0, 0, 1, 0, 0};
        const auto at = bytes.find(length + length);
        BOOST_REQUIRE(at != std::string::npos);
        talus::write_file(path, bytes.replace(at, 16, larger + larger));
    });
    for (const bool deflated : {false, true})
        damage.local("fclib_local/vectors/mu is cut off, but must be whole", [&](const auto& path) {
            Hdf5Surgery(path).replace_by_first_chunk("fclib_local/vectors/mu", 50'000'000'000, 1000,
                                                     deflated);
        });
}

BOOST_AUTO_TEST_CASE(velocities_never_written_are_zero) {
    const Damage damage;
    talus::write_problem(damage.path, random_global<3>(1));
    const auto size = talus::read_problem<3>(damage.path).global->force.size();
    Hdf5Surgery(damage.path).replace_by_claim("guesses/1/v", static_cast<std::size_t>(size));
    BOOST_TEST(talus::read_problem<3>(damage.path).guesses[0].velocity.norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(words_of_any_length_are_read) {
    const Damage damage;
    const auto content = random_local<3>(1);
    talus::write_problem(damage.path, content);
    Hdf5Surgery(damage.path).replace_by_variable_text("fclib_local/info/title", "of any length");
    Hdf5Surgery(damage.path).remove("fclib_local/info/description");
    const auto info = talus::read_problem<3>(damage.path).info;
    BOOST_TEST(info.title == "of any length");
    BOOST_TEST(info.description == "");
}

BOOST_AUTO_TEST_CASE_TEMPLATE(a_driven_cell_has_no_room_in_a_file, D, dimensions) {
    constexpr int dim = D::value;
    RandomBlocks random(77);
    const auto p = Rigid<dim>{.driven = true}.make(random, {.mu = 0.5});
    const auto is_refusal = [](const talus::input_error& error) {
        return std::string(error.what()) ==
               "periodic cell is driven by a stress, but must be imposed: a problem file has no "
               "room for it";
    };
    BOOST_CHECK_EXCEPTION(talus::global_form<dim>(p), talus::input_error, is_refusal);
}

BOOST_AUTO_TEST_SUITE_END()
