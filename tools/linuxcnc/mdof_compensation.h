/* SPDX-License-Identifier: GPL-2.0-or-later */
/* Mathematics of the realtime component mdof_compensation. The component receives a table of
   corrections record by record, interpolates the correction at the position of the machine, and
   changes its offset to this correction with limited velocity and acceleration. The code does not
   use HAL and allocates no memory; tests can therefore run it outside LinuxCNC. C99 and C++.

   Positions, corrections and offsets are in machine units (mm or inch), times in s. X, Y, Z are 0,
   1, 2. The correction is added to a command. */
#ifndef MDOF_COMPENSATION_H
#define MDOF_COMPENSATION_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#define MDOF_POSITION_TOLERANCE 1e-6 /* machine units */
#define MDOF_MAX_COORDINATES 1024    /* of an axis of the grid */

/* Corrections at the nodes of a grid. The order of the nodes is X fastest, then Y, then Z. If an
   axis has only one coordinate, the correction does not depend on its position. */
struct mdof_table {
  int n[3];
  double coordinate[3][MDOF_MAX_COORDINATES]; /* strictly increasing */
  double* correction;                         /* nodes * 3 */
  long nodes;
  long generation_number;
  bool is_simulated;
  double largest; /* largest |correction| */
};

/* Finds the cell that contains `x`. `share` is the position of x in this cell: 0 at its lower end,
   1 at its upper end. If x is outside the grid, the result is the nearer end of the grid. Returns
   whether x is inside the grid. */
static inline bool mdof_cell(const double* at, int n, double x, int* cell, double* share) {
  int low = 0, high = n - 1;
  *cell = 0;
  *share = 0;
  if (n < 2) return fabs(x - at[0]) <= MDOF_POSITION_TOLERANCE;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (at[middle] <= x)
      low = middle;
    else
      high = middle;
  }
  *cell = low;
  *share = (x - at[low]) / (at[high] - at[low]);
  if (*share >= 0 && *share <= 1) return true;
  *share = *share > 1 ? 1 : 0;
  return x >= at[0] - MDOF_POSITION_TOLERANCE && x <= at[n - 1] + MDOF_POSITION_TOLERANCE;
}

/* The correction at a position, interpolated linearly along each axis between the nodes. Outside
   the grid, it is the correction at the end of the grid. Returns whether the position is inside. */
static inline bool mdof_table_at(const struct mdof_table* table, const double position[3],
                                 double correction[3]) {
  int cell[3];
  double share[3];
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
    inside = mdof_cell(table->coordinate[axis], table->n[axis], position[axis], &cell[axis],
                       &share[axis]) &&
             inside;
  for (int k = 0; k < 3; ++k) correction[k] = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    long node = 0, stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int upper = corner >> axis & 1;
      weight *= upper ? share[axis] : 1 - share[axis];
      node += stride * (cell[axis] + upper);
      stride *= table->n[axis];
    }
    if (weight == 0) continue; /* the node may not exist */
    for (int k = 0; k < 3; ++k) correction[k] += weight * table->correction[3 * node + k];
  }
  return inside;
}

struct mdof_limits {
  double fade_velocity; /* limit of the velocity after a change of tables; a path may need more */
  double max_velocity;  /* of the offset */
  double max_acceleration; /* of the offset */
  double max_offset;       /* largest |offset| */
};

struct mdof_offset {
  double value, velocity;
};

/* Limits x to ±most. An invalid limit (0 or less, not a number) gives 0. */
static inline double mdof_clamp(double x, double most) {
  if (!(most > 0)) return 0;
  return x > most ? most : x < -most ? -most : x;
}

/* The velocity at which the offset can still stop after `distance`, because in each period the
   velocity decreases by at most step = max_acceleration * period. If the velocity is m * step,
   the offset needs the distance m (m + 1) / 2 * step * period until it stops. */
static inline double mdof_approach(double distance, const struct mdof_limits* limits,
                                   double period) {
  const double step = limits->max_acceleration * period; /* change of velocity */
  const double far = fabs(distance);
  double velocity = step * (sqrt(1 + 8 * far / (step * period)) - 1) / 2;
  if (velocity > far / period) velocity = far / period;
  velocity = mdof_clamp(velocity, limits->fade_velocity);
  return distance < 0 ? -velocity : velocity;
}

/* Changes the offset of one axis in one period. `before` and `now`: the corrections at the last and
   at the present position, both from the same table. The velocity of the offset is the sum of two
   velocities: the change of the correction in this period, and the approach to the correction if
   the offset differs from it, for example after a new table. The sum is at most the larger of
   fade_velocity and the velocity of the correction. Returns whether the offset still differs from
   the correction. */
static inline bool mdof_follow(struct mdof_offset* offset, double before, double now,
                               const struct mdof_limits* limits, double period) {
  const double wanted_before = mdof_clamp(before, limits->max_offset);
  const double wanted = mdof_clamp(now, limits->max_offset);
  const double step = limits->max_acceleration * period;
  const double most =
      fmax(limits->max_offset, fabs(offset->value)); /* no jump after a change of max_offset */
  const double asked = (wanted - wanted_before) / period;
  double velocity = asked + mdof_approach(wanted_before - offset->value, limits, period);
  velocity = mdof_clamp(velocity, fmax(limits->fade_velocity, fabs(asked)));
  velocity = mdof_clamp(velocity, limits->max_velocity);
  velocity = offset->velocity + mdof_clamp(velocity - offset->velocity, step);
  if (!(step > 0) || !isfinite(velocity)) velocity = 0; /* invalid limits: no motion */
  offset->value = mdof_clamp(offset->value + velocity * period, most);
  offset->velocity = velocity;
  return wanted != now || fabs(wanted - offset->value) > 1e-7;
}

/* The loader sends a table as many small records, because the work in one servo period must be
   limited. The component uses only complete tables. If a loader ends before its table is complete,
   the component discards the table. A record is a word, session << 4 | kind, and three numbers. The
   session is a number that is the same in all records of one table from one loader. */
enum mdof_record_kind {
  MDOF_ALIVE = 1,      /* mdofd is connected: 1 or 0; the table in use is active: 1 or 0 */
  MDOF_CLEAR = 2,      /* no table is active */
  MDOF_BEGIN = 3,      /* generation; 1: simulated data, 0: not */
  MDOF_SIZE = 4,       /* numbers of coordinates of X, Y, Z; the coordinates follow, X first */
  MDOF_COORDINATE = 5, /* one coordinate in machine units */
  MDOF_NODE = 6,       /* corrections of X, Y, Z at one node in machine units */
  MDOF_END = 7
};

enum mdof_received {
  MDOF_GOES_ON,
  MDOF_COMPLETE,
  MDOF_OUT_OF_ORDER,
  MDOF_TOO_LARGE,   /* more coordinates or nodes than the memory holds */
  MDOF_BAD_NUMBER,  /* not finite, not increasing */
  MDOF_BEYOND_LIMIT /* a correction beyond max_offset */
};

struct mdof_receiver {
  struct mdof_table* table; /* the table that is filled; not the table in use */
  long most_nodes;
  unsigned session; /* 0: no table is being received */
  int coordinates, coordinates_received;
  long nodes_received;
};

static inline enum mdof_received mdof_refuse(struct mdof_receiver* r, enum mdof_received why) {
  r->session = 0;
  return why;
}

static inline enum mdof_received mdof_receive_size(struct mdof_receiver* r, const double v[3]) {
  struct mdof_table* t = r->table;
  if (t->nodes) return mdof_refuse(r, MDOF_OUT_OF_ORDER);
  t->nodes = 1;
  r->coordinates = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(v[axis] >= 1 && v[axis] <= MDOF_MAX_COORDINATES)) return mdof_refuse(r, MDOF_TOO_LARGE);
    t->n[axis] = lrint(v[axis]);
    t->nodes *= t->n[axis];
    r->coordinates += t->n[axis];
  }
  return t->nodes <= r->most_nodes ? MDOF_GOES_ON : mdof_refuse(r, MDOF_TOO_LARGE);
}

static inline enum mdof_received mdof_receive_coordinate(struct mdof_receiver* r, double x) {
  struct mdof_table* t = r->table;
  int axis = 0, i = r->coordinates_received++;
  if (!t->nodes || i >= r->coordinates) return mdof_refuse(r, MDOF_OUT_OF_ORDER);
  while (i >= t->n[axis]) i -= t->n[axis++];
  if (!isfinite(x) || (i > 0 && x <= t->coordinate[axis][i - 1]))
    return mdof_refuse(r, MDOF_BAD_NUMBER);
  t->coordinate[axis][i] = x;
  return MDOF_GOES_ON;
}

static inline enum mdof_received mdof_receive_node(struct mdof_receiver* r, const double v[3],
                                                   double max_offset) {
  struct mdof_table* t = r->table;
  if (!t->nodes || r->coordinates_received != r->coordinates || r->nodes_received >= t->nodes)
    return mdof_refuse(r, MDOF_OUT_OF_ORDER);
  for (int k = 0; k < 3; ++k) {
    const double size = fabs(v[k]);
    if (!isfinite(v[k])) return mdof_refuse(r, MDOF_BAD_NUMBER);
    if (size > max_offset) return mdof_refuse(r, MDOF_BEYOND_LIMIT);
    if (size > t->largest) t->largest = size;
    t->correction[3 * r->nodes_received + k] = v[k];
  }
  ++r->nodes_received;
  return MDOF_GOES_ON;
}

/* Handles one record of a table, from MDOF_BEGIN to MDOF_END. Ignores records of a session whose
   table was refused or replaced by that of another loader, and returns MDOF_GOES_ON for them. */
static inline enum mdof_received mdof_receive(struct mdof_receiver* r, unsigned word,
                                              const double v[3], double max_offset) {
  const unsigned session = word >> 4;
  const unsigned kind = word & 15;
  if (kind == MDOF_BEGIN) {
    r->session = session;
    r->coordinates = r->coordinates_received = 0;
    r->nodes_received = 0;
    r->table->nodes = 0;
    r->table->largest = 0;
    r->table->generation_number = lrint(v[0]);
    r->table->is_simulated = v[1] != 0;
    return MDOF_GOES_ON;
  }
  if (!session || session != r->session) return MDOF_GOES_ON;
  if (kind == MDOF_SIZE) return mdof_receive_size(r, v);
  if (kind == MDOF_COORDINATE) return mdof_receive_coordinate(r, v[0]);
  if (kind == MDOF_NODE) return mdof_receive_node(r, v, max_offset);
  if (kind != MDOF_END || !r->table->nodes || r->nodes_received != r->table->nodes)
    return mdof_refuse(r, MDOF_OUT_OF_ORDER);
  r->session = 0;
  return MDOF_COMPLETE;
}

#endif
