// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/law/concepts.hpp>

#include <utility>

namespace talus {

/// What a law without the PreparableLaw extension keeps over the sweeps: its block of W.
template <int Dim>
struct PlainBlock {
    Matrix<Dim> W;  ///< diagonal Delassus block [1/kg]
};

/// The value that `prepare(law, W)` returns.
template <class Law, int Dim>
struct PreparedType {
    using type = PlainBlock<Dim>;
};
template <class Law, int Dim>
requires PreparableLaw<Law, Dim>
struct PreparedType<Law, Dim> {
    using type = decltype(std::declval<const Law&>().prepare(std::declval<const Matrix<Dim>&>()));
};
template <class Law, int Dim>
using Prepared = typename PreparedType<Law, Dim>::type;

/// What `law` wants to keep of W, for any law.
template <int Dim, ContactLaw<Dim> Law>
Prepared<Law, Dim> prepare(const Law& law, const Matrix<Dim>& w) {
    if constexpr (PreparableLaw<Law, Dim>)
        return law.prepare(w);
    else
        return {w};
}

/// The impulse that solves the one-contact problem whose present impulse r gives the velocity
/// u = W r + b, for any law.
template <int Dim, ContactLaw<Dim> Law>
Vector<Dim> improved(const Law& law, const Prepared<Law, Dim>& prepared, const Vector<Dim>& u,
                     const Vector<Dim>& r) {
    if constexpr (PreparableLaw<Law, Dim>)
        return law.improved(prepared, u, r);
    else
        return law.solve(LocalProblem<Dim>{prepared.W, u - prepared.W * r}, r);
}

}  // namespace talus
