// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <talus/spatial/pose.hpp>

#include <random>

/// Random vectors, rotations and poses for tests; seeds are given by the test.
namespace random_input {

inline double uniform(std::mt19937& rng, double low = -1.0, double high = 1.0) {
    return std::uniform_real_distribution<double>(low, high)(rng);
}

template <class V>
V vector(std::mt19937& rng, double scale = 1.0) {
    V v;
    for (int i = 0; i < v.size(); ++i) v[i] = scale * uniform(rng);
    return v;
}

template <class V>
V unit(std::mt19937& rng) {
    V v;
    do v = vector<V>(rng);
    while (v.norm() < 0.1 || v.norm() > 1.0);
    return v.normalized();
}

template <int Dim>
talus::Rotation<Dim> rotation(std::mt19937& rng) {
    return talus::Rotation<Dim>::exp(vector<talus::AngularVector<Dim>>(rng, 3.0));
}

template <int Dim>
talus::Pose<Dim> pose(std::mt19937& rng, double scale = 1.0) {
    return {vector<talus::Vector<Dim>>(rng, scale), rotation<Dim>(rng)};
}

}  // namespace random_input
