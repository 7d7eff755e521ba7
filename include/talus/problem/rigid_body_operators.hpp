// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/problem/delassus_product.hpp>

#include <type_traits>

namespace talus {

/// Whether every inverse inertia tensor of `m` is exactly a multiple of the identity (balls and
/// cubes, and everything in the plane). Then DelassusProduct<Dim, double> applies.
template <int Dim>
bool has_scalar_inertia(const InverseMass<Dim>& m) {
    for (const AngularMatrix<Dim>& i : m.angular)
        if (i != AngularMatrix<Dim>::Identity() * i(0, 0)) return false;
    return true;
}

/// The operators of problems of rigid bodies, which a solver keeps between solves: in the plane
/// one, in space one for scalar inertia and one for all else.
template <int Dim, int Rows = Dim>
class RigidBodyOperators {
  public:
    /// Takes a new problem in, at zero impulses, keeping a reference to `jacobian`; returns f(W)
    /// for the quicker W that applies.
    template <class F>
    decltype(auto) with(const ContactJacobian<Dim>& jacobian, const InverseMass<Dim>& inverse_mass,
                        F&& f) {
        if constexpr (rotation_dof<Dim> != 1)
            if (!inverse_mass.free_axes.empty() || !jacobian.cell_lever.empty() ||
                !has_scalar_inertia(inverse_mass)) {
                tensor_.assign(jacobian, inverse_mass);
                return f(tensor_);
            }
        scalar_.assign(jacobian, inverse_mass);
        return f(scalar_);
    }

  private:
    struct None {};
    using Tensor = std::conditional_t<rotation_dof<Dim> == 1, None,
                                      DelassusProduct<Dim, AngularMatrix<Dim>, Rows>>;
    [[no_unique_address]] Tensor tensor_;
    DelassusProduct<Dim, double, Rows> scalar_;
};

}  // namespace talus
