// Special functions for distributions, of + - * / sqrt only: the same bits from every compiler and
// library, which those of the C library are not.
#pragma once

namespace mdof::algo {

double natural_log(double x);  // x > 0; to 1e-15 relative of 1 + |ln x|
double exponential(double x);  // to 1e-15 relative; 0 below -700, for |x| <= 700 else
double normal_density(double z);
double normal_cdf(double z);  // to 1e-13 relative, in the lower tail too
double log_gamma(double x);   // x > 0; to 1e-14 relative of 1 + |result|

// P(T > x) of Student's t with `dof` degrees of freedom, x >= 0, and its density: to 1e-12
// relative. By the continued fraction of the incomplete beta function (DLMF 8.17.22).
double t_upper_tail(double x, double dof);
double t_density(double x, double dof);

}  // namespace mdof::algo
