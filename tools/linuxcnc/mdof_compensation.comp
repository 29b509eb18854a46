// SPDX-License-Identifier: GPL-2.0-or-later
component mdof_compensation "Compensation of X, Y and Z by the volumetric table that mdofd serves";

description """
The component works between motion and the drives. It adds the correction that the table has at the commanded
position to the commands of three linear joints, and subtracts this correction from the feedback, so that planner
and display do not show it. The position is always passed on: after a fault, the offset is held and then reduced
to 0. A second joint of an axis, as of a gantry, gets the same offset through the pins 3 to 5.

The table comes from mdof_compensation_loader. See tools/linuxcnc/README.md of mdof.""";

pin in float pos_in_#[6] "joint.N.motor-pos-cmd of X, Y, Z (pins 0 to 2) and of their second joints (pins 3 to 5)";
pin out float pos_out_#[6] "Position command to the drive";
pin in float fb_in_#[6] "Position feedback from the drive";
pin out float fb_out_#[6] "Feedback without the offset, for joint.N.motor-pos-fb";
pin in float joint_pos_#[3] "joint.N.pos-cmd of X, Y, Z: the position at which the table is read";
pin out float offset_#[3] "Offset that is added to X, Y, Z";
pin in bit homing_#[6] "joint.N.homing";
pin in bit all_homed "motion.is-all-homed";
pin in bit machine_on "motion.motion-enabled; while FALSE, the offset does not change";
pin in bit enable = 1 "FALSE: the offset is reduced to 0";
pin out bit homing_inhibit "For motion.homing-inhibit; TRUE while the offset is not 0, because homing would make the offset permanent";
pin out bit active "A table is applied";
pin out u32 generation "Generation of the table in use; 0: no table";
pin out float max_abs_offset "Largest correction of the table in use";
pin out bit simulated "The table in use contains simulated data";
pin out bit inside "The commanded position is inside the table; outside, the correction at the end of the table is applied";
pin out bit limited "The offset has not yet reached the correction of the table";
pin out bit connected "mdofd answers the loader";
pin out float age_s "Time since mdofd last confirmed that the table in use is the active table";
pin out bit fault "A fault is present, see fault-code; the offset is held for hold-s, then reduced to 0";
pin out u32 fault_code "0 no fault, 1 the loader sends nothing, 2 age-s is too large, 3 a position is not a number";
pin out u32 refused "Number of tables that were refused after the start";
pin out u32 refused_code "Reason of the last refusal: 2 records out of order, 3 too many nodes, 4 invalid number, 5 correction above max-offset";

param rw float fade_velocity = 0.04 "Velocity of the offset after a change of tables, machine units/s";
param rw float max_velocity = 1 "Largest velocity of the offset, machine units/s";
param rw float max_acceleration = 50 "Largest acceleration of the offset, machine units/s^2";
param rw float max_offset = 0.1 "Largest permitted correction of a table, machine units";
param rw float loader_timeout_s = 5 "Longest time for which the loader may send nothing";
param rw float max_age_s = 3600 "Largest permitted age-s; above it, the table is no longer applied";
param rw float hold_s = 10 "Time for which the offset is held after a fault";

modparam int most_nodes = 100000 "Largest number of nodes of a table";
modparam int key = 0x6d646f66 "Key of the stream from the loader";

function feedback fp "Must run before motion-controller";
function command fp "Must run after motion-controller";

option singleton yes;
option extra_setup yes;
option extra_cleanup yes;
license "GPL"; // version 2 or later
author "mdof";

include "mdof_compensation.h";
include <hal.h>;
include <rtapi_slab.h>;
;;
#define MOST_RECORDS 64 /* read in one servo period */
#define NEAR_ZERO 1e-7
#define JOINTS 6 /* joint j belongs to axis j % 3 */

static hal_stream_t stream;
static struct mdof_table tables[2];
static const struct mdof_table* active_table; /* table in use; NULL: none */
static struct mdof_receiver receiver;
static struct mdof_offset offsets[3];
static double last_position[3]; /* the last valid positions */
static double silent_s, fault_s;

EXTRA_SETUP() {
  (void)prefix;
  (void)extra_arg;
  for (int i = 0; i < 2; ++i) {
    tables[i].correction = rtapi_kzalloc(3 * sizeof(double) * most_nodes, RTAPI_GFP_KERNEL);
    if (!tables[i].correction) return -ENOMEM;
  }
  receiver.table = &tables[0];
  receiver.most_nodes = most_nodes;
  return hal_stream_create(&stream, comp_id, key, 8192, "ufff");
}

EXTRA_CLEANUP() {
  if (stream.fifo) hal_stream_destroy(&stream);
  for (int i = 0; i < 2; ++i) rtapi_kfree(tables[i].correction);
}

static void apply(struct __comp_state* __comp_inst, const struct mdof_table* table) {
  active_table = table;
  generation = table ? table->generation_number : 0;
  max_abs_offset = table ? table->largest : 0;
  simulated = table && table->is_simulated;
  age_s = 0;
}

static void receive(struct __comp_state* __comp_inst) {
  union hal_stream_data record[4];
  for (int i = 0; i < MOST_RECORDS && hal_stream_readable(&stream); ++i) {
    if (hal_stream_read(&stream, record, NULL) < 0) return;
    const double values[3] = {record[1].f, record[2].f, record[3].f};
    silent_s = 0;
    switch (record[0].u & 15) {
      case MDOF_ALIVE:
        connected = values[0] != 0;
        if (values[1] != 0) age_s = 0;
        continue;
      case MDOF_CLEAR:
        apply(__comp_inst, NULL);
        continue;
    }
    const enum mdof_received found = mdof_receive(&receiver, record[0].u, values, max_offset);
    if (found == MDOF_COMPLETE) {
      apply(__comp_inst, receiver.table);
      receiver.table = &tables[receiver.table == &tables[0]];
    } else if (found != MDOF_GOES_ON) {
      refused += 1;
      refused_code = found;
    }
  }
}

static void judge(struct __comp_state* __comp_inst, const double position[3], double period) {
  silent_s += period;
  age_s = active_table ? age_s + period : 0;
  if (silent_s > loader_timeout_s) connected = 0;
  fault_code = 0;
  if (active_table && silent_s > loader_timeout_s) fault_code = 1;
  if (active_table && age_s > max_age_s) fault_code = 2;
  if (!isfinite(position[0] + position[1] + position[2])) fault_code = 3;
  fault = fault_code != 0;
  fault_s = fault ? fault_s + period : 0;
}

FUNCTION(feedback) {
  for (int j = 0; j < JOINTS; ++j) fb_out(j) = fb_in(j) - offsets[j % 3].value;
}

FUNCTION(command) {
  const double seconds = period * 1e-9;
  const struct mdof_limits limits = {fade_velocity, max_velocity, max_acceleration, max_offset};
  const double position[3] = {joint_pos(0), joint_pos(1), joint_pos(2)};
  double before[3] = {0, 0, 0}, now[3] = {0, 0, 0};
  receive(__comp_inst);
  judge(__comp_inst, position, seconds);
  bool asked = active_table && enable && all_homed;
  for (int j = 0; j < JOINTS; ++j) asked = asked && !homing(j);
  const bool stands = asked && (machine_on ? fault && fault_s <= hold_s : true);
  active = asked && !stands && !fault;
  inside = 0;
  if (active) {
    mdof_table_at(active_table, last_position, before);
    inside = mdof_table_at(active_table, position, now);
  }
  limited = 0;
  homing_inhibit = 0;
  for (int k = 0; k < 3; ++k) {
    if (stands) before[k] = now[k] = offsets[k].value;
    if (mdof_follow(&offsets[k], before[k], now[k], &limits, seconds)) limited = 1;
    if (fabs(offsets[k].value) > NEAR_ZERO) homing_inhibit = 1;
    offset(k) = offsets[k].value;
    if (fault_code != 3) last_position[k] = position[k];
  }
  for (int j = 0; j < JOINTS; ++j) pos_out(j) = pos_in(j) + offsets[j % 3].value;
}
