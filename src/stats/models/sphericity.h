#pragma once
#include <Eigen/Core>

namespace icome::stats {

/// A test whether the differences between a within-subjects effect's levels vary alike, and the factors that
/// shrink degrees of freedom if they do not. NaN where there are too few subjects. R's mauchly.test gives
/// the same p for columns that are orthonormal contrasts already; where it forms the contrasts (arguments M,
/// X), R 4.2 uses the number of columns before that step instead of the number after it, and p differs in
/// about the fourth digit.
struct Sphericity {
  double mauchly_w = 0.0;           // 1: spherical (Mauchly 1940)
  double p = 0.0;                   // of W, with Box's second-order term
  double greenhouse_geisser = 0.0;  // epsilon of Box (1954); Greenhouse and Geisser (1959)
  double huynh_feldt = 0.0;         // epsilon of Huynh and Feldt (1976) with Lecoutre's (1991) correction for
                                    // groups; as computed, may exceed 1
  double lower_bound = 0.0;         // the smallest possible epsilon
};

/// The sphericity of an effect with d > 1 degrees of freedom: `residuals` has a row for each subject and d
/// columns, its scores on orthonormal contrasts less those that the between-subjects model fits;
/// `error_df` is subjects less groups.
Sphericity sphericity_of(const Eigen::MatrixXd& residuals, int error_df);

}  // namespace icome::stats
