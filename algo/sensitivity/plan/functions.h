// Special functions for distributions. They use only + - * / sqrt, so their results have the same
// bits with every compiler and C library.
#pragma once

namespace mdof::algo {

double natural_log(double x);  // x > 0; error below 1e-15 of 1 + |ln x|
double exponential(double x);  // x <= 700; relative error below 1e-15; 0 for x < -700
double normal_density(double z);
double normal_cdf(double z);  // relative error below 1e-13, also in the lower tail
double log_gamma(double x);   // x > 0; error below 1e-14 of 1 + |result|

// Upper tail P(T > x), x >= 0, and density of Student's t distribution with `dof` degrees of
// freedom. Relative error below 1e-12. Uses the continued fraction of the incomplete beta function
// (DLMF 8.17.22).
double t_upper_tail(double x, double dof);
double t_density(double x, double dof);

}  // namespace mdof::algo
