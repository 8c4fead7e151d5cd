#pragma once

#include "modal/block_factor.h"

#include <functional>

namespace ode::soft {

/// Lowest eigenpairs of K x = lambda M x.
struct EigenPairs {
    Eigen::VectorXd value;  ///< lambda [1/s^2], ascending
    Eigen::MatrixXd vector; ///< columns, mass-orthonormal
    bool complete = true;   ///< every pair up to `upper` is there
    double beyond = 0;      ///< a lambda between the last pair given and the next one known
    Eigen::Index steps = 0; ///< blocks multiplied
};

struct LanczosOptions {
    double upper = 0;                     ///< pairs with lambda <= upper are wanted [1/s^2]
    Eigen::Index max_pairs = 0;           ///< 0: no limit but memory
    double tolerance = 1e-7;              ///< residual of the inverted problem, relative
    std::size_t basis_bytes = 768u << 20; ///< the basis restarts when it would outgrow this
    /// Converged pairs and a share done in [0, 1]; false abandons.
    std::function<bool(Eigen::Index, double)> progress;
};

/// Block Lanczos with (K + shift M)^-1 M in the mass inner product, full reorthogonalisation and
/// thick restart (Grimes, Lewis and Simon 1994, doi:10.1137/S0895479888151111; Wu and Simon 2000,
/// doi:10.1137/S0895479898334605). A block of eight finds eigenvalues of multiplicity up to eight
/// in exact arithmetic, where single-vector Lanczos (Spectra) finds the second of an equal pair
/// only through rounding; and a sparse solve of eight vectors costs about two of one.
/// @param factor    of K + shift M
/// @param deflated  mass-orthonormal columns to keep out: rigid motions, pairs already known
/// @throws Cancelled when progress says so.
EigenPairs lowest_pairs(const BlockSystem& system, const BlockFactor& factor, double shift,
                        const RowMatrix& deflated, const LanczosOptions& options,
                        unsigned seed = 1);

/// Thrown out of a long computation that the caller's progress function stopped.
struct Cancelled {};

} // namespace ode::soft
