// Special functions for distributions, from + - * / sqrt only: every compiler and library gives the
// same bits, unlike the functions of the C library.
#pragma once

namespace mdof::algo {

double natural_log(double x);  // x > 0; error below 1e-15 of 1 + |ln x|
double exponential(double x);  // relative error below 1e-15; 0 below -700, else |x| <= 700
double normal_density(double z);
double normal_cdf(double z);  // relative error below 1e-13, in the lower tail too
double log_gamma(double x);   // x > 0; error below 1e-14 of 1 + |result|

// P(T > x) of Student's t with `dof` degrees of freedom, x >= 0, and its density; relative error
// below 1e-12. By the continued fraction of the incomplete beta function (DLMF 8.17.22).
double t_upper_tail(double x, double dof);
double t_density(double x, double dof);

}  // namespace mdof::algo
