% Simulation I in vectorised GNU Octave on one thread: a peer of mdof, beside sensitivity_numpy.py.
% Octave has no Philox; its own Mersenne Twister is used. Prints nanoseconds of processor time a trial, for
% the best array size, by histograms (accumarray) and by sorting. Statistics over all trials and in
% each of 20 bins of travel: mean, sd, min, max, quantiles, symmetric and shortest 95 % interval.
%   octave-cli sensitivity_octave.m [TRIALS]
1;

function out = errors_of (m)
  A = 1e-3; B = 50e-6; L = 10e-3; up = 20e-3; bins = 20;
  d = (rand (m, bins) + (0:bins-1)) * (60e-3 / bins);
  dy = (2 * rand (m, bins) - 1) * B;
  dz = (2 * rand (m, bins) - 1) * B;
  ex = (2 * rand (m, bins) - 1) * A;
  ey = (2 * rand (m, bins) - 1) * A;
  ez = (2 * rand (m, bins) - 1) * A;
  w = 1 + ez .* ez;
  p = (ey + ex .* ez) ./ w;
  q = (ex - ey .* ez) ./ w;
  c = dz - dy .* q + d .* p;
  b = c + L * q;
  f = c - L * q;
  a = c - L * p;
  w = 1 + ey .* ey;
  along = (ex .* ey - ez) ./ w;
  side = d .* along - (ex + ey .* ez) ./ w .* (up - dz) + dy;
  far = side - L * along;
  qx = (b - f) / (2 * L);
  px = ((b + f) / 2 - a) / L;
  rx = (far - side) / L;
  out = {1e6 * (side + qx * up + d .* rx - dy), 1e6 * ((b + f) / 2 - d .* px - dz), ...
         1e6 * (qx - ex), 1e6 * (px - ey), 1e6 * (rx - ez)};
end

function s = moments_of (s, out)
  for k = 1:5
    x = out{k};
    s.sum(k,:) += sum (x);
    s.square(k,:) += sumsq (x);
    s.min(k,:) = min (s.min(k,:), min (x));
    s.max(k,:) = max (s.max(k,:), max (x));
  end
end

function s = no_moments ()
  s = struct ("sum", zeros (5, 20), "square", zeros (5, 20), "min", inf (5, 20), "max", -inf (5, 20));
end

function [q, low, high] = of_sorted (x)
  n = numel (x);
  k = floor (0.95 * n);
  [~, best] = min (x(k+1:n) - x(1:n-k));
  q = x(ceil ([0.025 0.25 0.5 0.75 0.975] * n));
  low = x(best);
  high = x(best + k);
end

function by_sorting (trials, m)
  s = no_moments ();
  rounds = trials / (20 * m);
  kept = zeros (rounds * m, 20, 5);
  for i = 1:rounds
    out = errors_of (m);
    s = moments_of (s, out);
    for k = 1:5
      kept((i-1)*m+1:i*m,:,k) = out{k};
    end
  end
  for k = 1:5
    x = sort (kept(:,:,k));
    for bin = 1:20
      of_sorted (x(:,bin));
    end
    of_sorted (sort (x(:)));
  end
end

function of_counts (counts, edges)
  total = [0; cumsum(counts)];
  used = [true; counts > 0];
  total = total(used);
  edges = edges(used);
  n = total(end);
  interp1 (total, edges, [0.025 0.25 0.5 0.75 0.975] * n);
  from = (0:1/8192:0.05) * n;
  [~, ~] = min (interp1 (total, edges, from + 0.95 * n, "linear", "extrap") - interp1 (total, edges, from));
end

function by_histogram (trials, m)
  core = 8192;
  s = no_moments ();
  out = errors_of (500);
  for k = 1:5
    x = sort (out{k}(:));
    q = x([100 9900]);
    low(k) = mean (q) - (q(2) - q(1));
    per_width(k) = core / (2 * (q(2) - q(1)));
    counts{k} = zeros (core * 20, 1);
  end
  offset = (0:19) * core + 1;
  for i = 1:trials / (20 * m)
    out = errors_of (m);
    s = moments_of (s, out);
    for k = 1:5
      index = min (max (floor ((out{k} - low(k)) * per_width(k)), 0), core - 1) + offset;
      counts{k} += accumarray (index(:), 1, [core * 20, 1]);
    end
  end
  for k = 1:5
    edges = low(k) + (0:core)' / per_width(k);
    of_output = reshape (counts{k}, core, 20);
    of_counts (sum (of_output, 2), edges);
    for bin = 1:20
      of_counts (of_output(:,bin), edges);
    end
  end
end

function ns = best_ns (work, trials, sizes)
  ns = Inf;
  for m = sizes(20 * sizes <= trials)
    for again = 1:2
      begin = cputime ();
      work (trials, m);
      ns = min (ns, (cputime () - begin) / trials * 1e9);
    end
  end
end

arguments = argv ();
trials = 2e6;
if (numel (arguments) > 0)
  trials = str2double (arguments{1});
end
histogram_ns = best_ns (@by_histogram, trials, [500 2500 10000 50000]);
sorting_ns = best_ns (@by_sorting, trials, [500 2500 10000]);
printf ("octave %s, histograms: %.1f ns a trial\n", version (), histogram_ns);
printf ("octave %s, sorting: %.1f ns a trial\n", version (), sorting_ns);
