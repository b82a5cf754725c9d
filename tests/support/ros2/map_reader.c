/* lifeline-ros2-map-reader --domain N --seconds S
 *
 * Subscribes rt/lifeline/map as ROS 2's own tools do (reliable, transient local), with Cyclone DDS,
 * and prints each map as one line of JSON: its cells row by row from below, '?' unknown, '.' free,
 * '#' occupied, 'X' for anything else. Ends after S seconds, or once nobody publishes any more.
 * Exit status: 0, 1 when Cyclone DDS refuses something, 2 on wrong use. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dds/dds.h"
#include "mapping.h"

static const char kLoopbackOnly[] =
    "<CycloneDDS><Domain id=\"any\"><General>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>47</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

static char sign_of(int8_t cost) {
  if (cost == -1) return '?';
  if (cost == 0) return '.';
  return cost == 100 ? '#' : 'X';
}

static void print_map(const nav_msgs_msg_dds__OccupancyGrid_* map) {
  printf("{\"frame\":\"%s\",\"resolution\":%.9g,\"width\":%u,\"height\":%u,\"x\":%.17g,\"y\":%.17g,"
         "\"w\":%.17g,\"cells\":\"",
         map->header.frame_id, (double)map->info.resolution, map->info.width, map->info.height,
         map->info.origin.position.x, map->info.origin.position.y, map->info.origin.orientation.w);
  for (uint32_t i = 0; i < map->data._length; ++i) putchar(sign_of(map->data._buffer[i]));
  puts("\"}");
  fflush(stdout);
}

static dds_entity_t open_reader(dds_entity_t participant) {
  const dds_entity_t topic = dds_create_topic(
      participant, &nav_msgs_msg_dds__OccupancyGrid__desc, "rt/lifeline/map", NULL, NULL);
  if (topic < 0) return topic;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

static int run(uint32_t domain, double seconds) {
  const dds_entity_t participant = dds_create_participant(domain, NULL, NULL);
  const dds_entity_t reader = participant < 0 ? participant : open_reader(participant);
  if (reader < 0) {
    fprintf(stderr, "lifeline-ros2-map-reader: %s\n", dds_strretcode(-reader));
    return 1;
  }
  const dds_time_t end = dds_time() + (dds_duration_t)(seconds * 1e9);
  bool had_writer = false;
  while (dds_time() < end) {
    void* sample[1] = {NULL};
    dds_sample_info_t info[1];
    while (dds_take(reader, sample, info, 1, 1) > 0) {
      if (info[0].valid_data) print_map(sample[0]);
      dds_return_loan(reader, sample, 1);
    }
    dds_subscription_matched_status_t matched;
    if (dds_get_subscription_matched_status(reader, &matched) == DDS_RETCODE_OK) {
      if (had_writer && matched.current_count == 0) break;
      had_writer = matched.current_count > 0;
    }
    dds_sleepfor(DDS_MSECS(20));
  }
  dds_delete(participant);
  return 0;
}

int main(int argc, char** argv) {
  if (argc != 5 || strcmp(argv[1], "--domain") != 0 || strcmp(argv[3], "--seconds") != 0) {
    fputs("usage: lifeline-ros2-map-reader --domain N --seconds S\n", stderr);
    return 2;
  }
  setenv("CYCLONEDDS_URI", kLoopbackOnly, 0);
  return run((uint32_t)atoi(argv[2]), atof(argv[4]));
}
