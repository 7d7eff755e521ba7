// SPDX-License-Identifier: BSL-1.0
#include "common/solver_gallery.hpp"

#include <talus/problem/delassus_product.hpp>

#include <utility>

#include "common/random_problem.hpp"

namespace {

template <int Dim>
class Gallery {
  public:
    using Law = talus::Coulomb<Dim>;
    using Vec = talus::Vector<Dim>;
    using Problem = talus::ContactProblem<Dim, Law>;

    explicit Gallery(unsigned seed, int rounds) : random_(seed) {
        for (int k = 0; k < rounds; ++k) {
            random_systems(k);
            with_known_solutions(k);
            repeated_contacts(k);
            between_obstacles(k);
            squeezed(k);
        }
        towers();
        single_contacts();
    }
    const std::vector<GalleryProblem<Dim>>& problems() const { return problems_; }

  private:
    void add(std::string name, Kind kind, Problem p) {
        problems_.push_back({std::move(name), kind, std::move(p)});
    }
    Problem random_problem(int bodies, int contacts, double arm, double mu, double mass_ratio = 3) {
        return RandomProblem<Dim, Law>{
            .bodies = bodies, .contacts = contacts, .mass_ratio = mass_ratio, .arm = arm}
            .make(random_, Law{mu});
    }
    std::vector<Vec> product(const Problem& p, const std::vector<Vec>& r) const {
        std::vector<Vec> u(r.size());
        talus::DelassusProduct<Dim>(p.jacobian, p.inverse_mass).multiply(r, u);
        return u;
    }
    void random_systems(int k) {
        for (const double mu : {0.0, 0.3, 1.0, 1e3}) {
            // Where mu is huge W_tn must vanish: no catastrophes of friction.
            const double arm = mu <= 1.0 ? 0.1 : 0.0;
            const Kind kind = mu <= 1.0 ? Kind::well_posed : Kind::rough;
            const std::string end = ", mu " + std::to_string(mu) + ", " + std::to_string(k);
            auto p = random_problem(8, 5, arm, mu);
            move_bodies_only(p, random_);
            add("random" + end, kind, p);
            add("random, micrometres" + end, kind, in_other_units(p, 1e6, 1e15, 1e3));
            for (auto& u : p.free_velocity) u.setZero();
            add("random, at rest" + end, Kind::well_posed, p);
            p = random_problem(5, 16, arm, mu);
            move_bodies_only(p, random_);
            add("hyperstatic" + end, Kind::hyperstatic, p);
        }
        // Velocities and impulses of the Painleve range: several solutions or none.
        auto p = random_problem(4, 4, 1.0, 2.0);
        add("long arms, " + std::to_string(k), Kind::unknown, p);
        p = random_problem(4, 10, 0.3, 0.8);
        add("any free velocity, " + std::to_string(k), Kind::unknown, p);
        p = random_problem(6, 12, 0.3, 0.5, 1e6);
        move_bodies_only(p, random_);
        add("masses of all sizes, " + std::to_string(k), Kind::solvable, p);
    }

    /// u_free from impulses and velocities that obey the law: in all statuses, then on their
    /// borders too.
    void with_known_solutions(int k) {
        for (const bool borders : {false, true})
            for (const double mu : {0.0, 0.5}) {
                const std::string end = std::string(borders ? ", on borders" : "") + ", mu " +
                                        std::to_string(mu) + ", " + std::to_string(k);
                auto p = random_problem(8, 6, 0.1, mu);
                set_solution(p, borders);
                add("known solution" + end, Kind::well_posed, p);
                p = random_problem(4, 10, 0.1, mu);
                set_solution(p, borders);
                add("known hyperstatic solution" + end, Kind::solvable, p);
            }
    }
    void set_solution(Problem& p, bool borders) {
        std::vector<Vec> r(p.contact_count(), Vec::Zero()), u = r;
        for (std::size_t c = 0; c < r.size(); ++c) {
            const double mu = p.laws[c].mu;
            const double pressure = random_.uniform(0.1, 1.0), speed = random_.uniform(0.1, 1.0);
            Vec along = random_.template normal<Dim>();
            along[0] = 0.0;
            along.normalize();
            switch (random_.integer(0, borders ? 5 : 2)) {
                case 0:  // open
                    u[c] = speed * Vec::Unit(0) + random_.uniform(0.0, 1.0) * along;
                    break;
                case 1:  // stuck
                    r[c] = pressure * (Vec::Unit(0) + random_.uniform(0.0, 0.9) * mu * along);
                    break;
                case 2:  // slipping
                    r[c] = pressure * (Vec::Unit(0) - mu * along);
                    u[c] = speed * along;
                    break;
                case 3:  // passing by
                    u[c] = speed * along;
                    break;
                case 4:  // touching
                    break;
                default:  // about to slip
                    r[c] = pressure * (Vec::Unit(0) - mu * along);
            }
        }
        const std::vector<Vec> moved = product(p, r);
        for (std::size_t c = 0; c < r.size(); ++c) p.free_velocity[c] = u[c] - moved[c];
    }

    /// The same point and normal two and three times.
    void repeated_contacts(int k) {
        auto p = random_problem(8, 5, 0.1, 0.4);
        move_bodies_only(p, random_);
        for (const std::size_t c : {0u, 0u, 3u}) append(p, c);
        add("repeated contacts, " + std::to_string(k), Kind::hyperstatic, p);
        // With different friction.
        p.laws[5].mu = 0.0;
        p.laws[7].mu = 0.9;
        add("repeated contacts, other friction, " + std::to_string(k), Kind::hyperstatic, p);
    }
    static void append(Problem& p, std::size_t c) {
        p.jacobian.a.push_back(p.jacobian.a[c]);
        p.jacobian.b.push_back(p.jacobian.b[c]);
        p.jacobian.frame.push_back(p.jacobian.frame[c]);
        p.jacobian.arm_a.push_back(p.jacobian.arm_a[c]);
        p.jacobian.arm_b.push_back(p.jacobian.arm_b[c]);
        p.free_velocity.push_back(p.free_velocity[c]);
        p.laws.push_back(p.laws[c]);
    }

    /// A contact without effective mass beside a common system.
    void between_obstacles(int k) {
        auto p = random_problem(8, 5, 0.1, 0.3);
        move_bodies_only(p, random_);
        p.inverse_mass.linear.push_back(0.0);
        p.inverse_mass.angular.push_back(p.inverse_mass.angular[0]);
        p.inverse_mass.angular.back().setZero();
        append(p, 2);
        p.jacobian.a[5] = 7;
        p.jacobian.b[5] = 8;
        const std::string end = ", " + std::to_string(k);
        p.free_velocity[5] = 0.3 * Vec::Unit(0) - 0.8 * Vec::Unit(1);
        add("obstacles part" + end, Kind::well_posed, p);
        p.free_velocity[5].setZero();
        add("obstacles rest" + end, Kind::well_posed, p);
        p.free_velocity[5] = -0.5 * Vec::Unit(1);
        add("obstacles slide" + end, Kind::well_posed, p);
        p.free_velocity[5] = -0.3 * Vec::Unit(0);
        add("obstacles approach" + end, Kind::infeasible, p);
        p.free_velocity[5] = -0.01 * Vec::Unit(0) + 0.8 * Vec::Unit(1);
        add("obstacles approach slowly" + end, Kind::infeasible, p);
    }

    /// A body, and a pile of three, between two obstacles that come nearer.
    void squeezed(int k) {
        for (const int height : {1, 3, 20})
            for (const double mu : {0.0, 0.5}) {
                const auto n = static_cast<std::size_t>(height) + 1;
                Problem p;
                p.inverse_mass.resize(n + 1);
                p.jacobian.resize(n);
                for (std::size_t i = 0; i < n; ++i) {
                    const bool moves = i + 1 < n;
                    p.inverse_mass.linear[i] = moves ? random_.uniform(0.3, 3.0) : 0.0;
                    p.inverse_mass.angular[i].setZero();
                    if (moves)
                        p.inverse_mass.angular[i] = 2.5 * talus::AngularMatrix<Dim>::Identity();
                    // Contact i is below body i; the lower obstacle comes last.
                    p.jacobian.a[i] = static_cast<talus::BodyIndex>(i);
                    p.jacobian.b[i] = static_cast<talus::BodyIndex>(i == 0 ? n : i - 1);
                    p.jacobian.frame[i].setIdentity();
                    p.jacobian.arm_a[i] = -0.5 * Vec::Unit(0);
                    p.jacobian.arm_b[i] = 0.5 * Vec::Unit(0);
                    p.free_velocity.push_back(0.1 * random_.template normal<Dim>());
                    p.laws.push_back({mu});
                }
                p.inverse_mass.linear[n] = 0.0;
                p.inverse_mass.angular[n].setZero();
                const auto end = " of " + std::to_string(height) + ", mu " + std::to_string(mu) +
                                 ", " + std::to_string(k);
                // Normals are parallel: the normal velocities add up to that of the obstacles.
                double sum = 0.0;
                for (const Vec& u : p.free_velocity) sum += u[0];
                p.free_velocity[n - 1][0] -= sum + 1.0;
                add("squeezed" + end, Kind::infeasible, p);
                p.free_velocity[n - 1][0] += 1.0;
                add("just held" + end, Kind::solvable, p);
                p.free_velocity[n - 1][0] += 1.0;
                add("let go" + end, height <= 3 ? Kind::well_posed : Kind::stiff, p);
            }
    }

    Problem tower(const std::vector<double>& masses, double mu) const {
        Problem p = stack_of_particles<Dim>(masses, Law{mu});
        p.free_velocity[0] = 0.1 * Vec::Unit(1) - Vec::Unit(0);
        return p;
    }
    void towers() {
        for (const double mu : {0.0, 0.05, 0.5}) {
            const std::string end = ", mu " + std::to_string(mu);
            add("tower" + end, Kind::hyperstatic, tower(std::vector<double>(12, 1.0), mu));
            add("light on heavy" + end, Kind::well_posed, tower({1e6, 1.0}, mu));
            add("heavy on light" + end, Kind::stiff, tower({1.0, 1e6}, mu));
            add("heavy and light in turn" + end, Kind::stiff,
                tower({1.0, 1e6, 1.0, 1e6, 1.0, 1e6}, mu));
            add("heavy above all" + end, Kind::stiff, tower({1.0, 1.0, 1.0, 1.0, 1.0, 1e6}, mu));
        }
    }
    void single_contacts() {
        for (const double mu : {0.0, 0.4, 1e3})
            for (const double normal : {-1.0, 0.0, 1.0})
                for (const double along : {0.0, 0.3}) {
                    auto p = tower({2.0}, mu);
                    p.free_velocity[0] = normal * Vec::Unit(0) + along * Vec::Unit(1);
                    add("single contact, mu " + std::to_string(mu) + ", u_free " +
                            std::to_string(normal) + " " + std::to_string(along),
                        mu <= 1.0 ? Kind::well_posed : Kind::rough, p);
                }
    }

    RandomBlocks random_;
    std::vector<GalleryProblem<Dim>> problems_;
};

}  // namespace

template <int Dim>
std::vector<GalleryProblem<Dim>> gallery_problems(unsigned seed, int rounds) {
    return Gallery<Dim>(seed, rounds).problems();
}
template std::vector<GalleryProblem<2>> gallery_problems<2>(unsigned, int);
template std::vector<GalleryProblem<3>> gallery_problems<3>(unsigned, int);
