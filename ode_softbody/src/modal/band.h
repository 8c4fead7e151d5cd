#pragma once

#include "modal/modal_problem.h"
#include "modal/two_level.h"

namespace ode::soft {

/// From the change d that one order more makes, f_p - f_{p+1}: the answer f_p - shift d and its
/// band, width |d|. The spaces are nested, so eigenvalues fall towards the truth.
struct Rule {
    double shift, width;
};
/// Orders 1 and 2 as they are, their bands generous.
inline constexpr Rule kPlain{0, 2};
/// Cubic, judged by quartic. What the quartic order leaves is e4 = g d. With lambda's error as
/// p^(-4a) at an edge of singularity a (Babuska and Suri 1994, doi:10.1137/1036141): g = 0.8 at a
/// clamped right-angled edge (a = 0.71), and toward zero where the shape is smooth. The middle,
/// 0.4, is the answer; the band reaches both ends, and 0.05 more for what refine() leaves.
inline constexpr Rule kQuartic{1.4, 0.45};
/// Cubic, judged by quadratic, where the mesh is too large for more: d is f3 - f2, negative. Curves
/// that were rebuilt cost both orders more than they show.
inline constexpr Rule kQuadratic{-0.1, 0.5}, kQuadraticRebuilt{-0.1, 0.7};

/// Modes of two neighbouring orders on one mesh, and how they correspond.
struct OrderPair {
    EigenPairs coarse, fine;
    Eigen::MatrixXd overlap; ///< (i, k): mass product of coarse vector i and fine vector k
};

/// Fills in the overlap of a pair whose vectors are there.
void fill_overlap(const Transfer& transfer, const ModalProblem& fine, OrderPair& pair);

/// What the facets would change, in cents a mode by rank; NaN where there is no such rank. A
/// solution of its own: a Rayleigh quotient of the curved body's shapes takes their bending for
/// stretching on the facets of a thin shell, and says an octave where the change is ten cents.
Eigen::VectorXd facet_change(const ModalProblem& problem, const EigenPairs& pairs,
                             const ModalOptions& options);

/// How far an answer is from its partner on the other order decides value and band.
/// @param facets  of facet_change(), or NULL
/// @return how many modes have no partner: their band is NaN.
std::size_t set_bands(ModalModel& model, const OrderPair& pair, bool coarse_answer,
                      const Rule& rule, const Eigen::VectorXd* facets);

/// Gives a band to those without, and sorts: the correction may exchange neighbours.
void finish_bands(ModalModel& model);

} // namespace ode::soft
