// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Dense>

#include "multiple_collisions.hpp"

namespace validation {

template <int Dim>
Eigen::MatrixXd PointCollision<Dim>::g() const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(contacts.size()),
                                                 Dim * static_cast<Eigen::Index>(mass.size()));
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const auto row = static_cast<Eigen::Index>(c);
        if (contacts[c].a != wall)
            rows.template block<1, Dim>(row, Dim * contacts[c].a) += contacts[c].normal;
        if (contacts[c].b != wall)
            rows.template block<1, Dim>(row, Dim * contacts[c].b) -= contacts[c].normal;
    }
    return rows;
}

template <int Dim>
Eigen::VectorXd PointCollision<Dim>::inverse_mass() const {
    Eigen::VectorXd result(Dim * static_cast<Eigen::Index>(mass.size()));
    for (std::size_t i = 0; i < mass.size(); ++i)
        result.segment<Dim>(Dim * static_cast<Eigen::Index>(i)).setConstant(1.0 / mass[i]);
    return result;
}

template <int Dim>
Eigen::VectorXd PointCollision<Dim>::begin() const {
    Eigen::VectorXd result(Dim * static_cast<Eigen::Index>(mass.size()));
    for (std::size_t i = 0; i < mass.size(); ++i)
        result.segment<Dim>(Dim * static_cast<Eigen::Index>(i)) = velocity[i];
    return result;
}

template <int Dim>
Eigen::MatrixXd PointCollision<Dim>::delassus() const {
    return g() * inverse_mass().asDiagonal() * g().transpose();
}

template <int Dim>
Eigen::VectorXd PointCollision<Dim>::restitution() const {
    Eigen::VectorXd e(static_cast<Eigen::Index>(contacts.size()));
    for (Eigen::Index c = 0; c < e.size(); ++c) e[c] = contacts[static_cast<std::size_t>(c)].e;
    return e;
}

template <int Dim>
typename PointCollision<Dim>::Result PointCollision<Dim>::moreau() const {
    const Eigen::VectorXd u = g() * begin();
    return after_complementarity(u + restitution().cwiseProduct(u), 0.0 * u);
}

template <int Dim>
typename PointCollision<Dim>::Result PointCollision<Dim>::poisson() const {
    const Eigen::VectorXd u = g() * begin(), none = 0.0 * u;
    const Eigen::VectorXd compression = after_complementarity(u, none).impulse;
    const Eigen::VectorXd least = restitution().cwiseProduct(compression);
    const Eigen::VectorXd kept = compression + least;
    return after_complementarity(u + delassus() * kept, kept);
}

template <int Dim>
typename PointCollision<Dim>::Result PointCollision<Dim>::newton() const {
    const Eigen::VectorXd u = g() * begin();
    return with(delassus().ldlt().solve(-u - restitution().cwiseProduct(u)), true);
}

template <int Dim>
typename PointCollision<Dim>::Result PointCollision<Dim>::after_complementarity(
    const Eigen::VectorXd& b, const Eigen::VectorXd& before) const {
    const Enumeration all(frictionless(delassus(), b));
    if (all.velocities().size() != 1) throw std::logic_error("a projection is unique");
    const PlanarSolution& s = all.solutions().front();
    return with(before + normal_part(s.r), s.unique_impulses);
}

template <int Dim>
typename PointCollision<Dim>::Result PointCollision<Dim>::with(const Eigen::VectorXd& impulse,
                                                               bool unique) const {
    const Eigen::VectorXd end = begin() + inverse_mass().asDiagonal() * (g().transpose() * impulse);
    Result result{{}, impulse, unique};
    for (std::size_t i = 0; i < mass.size(); ++i)
        result.velocity.push_back(end.segment<Dim>(Dim * static_cast<Eigen::Index>(i)));
    return result;
}

template struct PointCollision<2>;
template struct PointCollision<3>;

}  // namespace validation
