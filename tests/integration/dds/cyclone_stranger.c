/* lifeline-cyclone-stranger --domain N --what KIND --seconds S
 *
 * A sender that does not keep the rules of idl/, on Cyclone DDS: writes one sample of KIND and, where
 * KIND breaks only that sample, a proper one after it; then stays until S seconds have passed.
 *
 * KIND: long_name (agent_id of 100 characters), oversized (payload of 100,000 octets),
 * long_payload (payload of 1,001 octets), bad_boolean (an octet of 2 where a boolean belongs),
 * wide_enumerator (a role of 65,536), proper. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dds/dds.h"
#include "stranger.h"

static const char kLoopbackOnly[] =
    "<CycloneDDS><Domain id=\"any\"><General>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast>"
    "<MaxMessageSize>1400B</MaxMessageSize><FragmentSize>1300B</FragmentSize></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>47</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

static char name[] = "stranger";

static lifeline_msg_Envelope envelope(void) {
  return (lifeline_msg_Envelope){.protocol_version = 1, .mission_id = name, .sender_id = name};
}

static dds_entity_t open_writer(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* topic_name) {
  const dds_entity_t topic = dds_create_topic(participant, type, topic_name, NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  if (type == &lifeline_msg_AgentStatus_desc) {
    dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_SECS(5));
  }
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return writer;
}

static dds_return_t write_tile(dds_entity_t writer, char* agent_id, int32_t tile_x,
                               uint32_t payload_octets) {
  lifeline_msg_TsdTile tile = {.envelope = envelope(), .agent_id = agent_id, .tile_x = tile_x};
  tile.revision = 1;
  tile.payload._buffer = calloc(payload_octets, 1);
  tile.payload._length = tile.payload._maximum = payload_octets;
  const dds_return_t result = dds_write(writer, &tile);
  free(tile.payload._buffer);
  return result;
}

static dds_return_t write_tiles(dds_entity_t participant, const char* what) {
  const dds_entity_t writer =
      open_writer(participant, &lifeline_msg_TsdTile_desc, "lifeline/tsd_tile");
  static char long_name[101];
  memset(long_name, 'x', sizeof long_name - 1);
  dds_return_t result = 0;
  if (strcmp(what, "long_name") == 0) {
    result = write_tile(writer, long_name, 0, 10);
  } else if (strcmp(what, "oversized") == 0) {
    return write_tile(writer, name, 0, 100000); /* blocks the samples after it, by design */
  } else if (strcmp(what, "long_payload") == 0) {
    result = write_tile(writer, name, 0, 1001);
  }
  return result < 0 ? result : write_tile(writer, name, 1, 10);
}

static dds_return_t write_statuses(dds_entity_t participant, const char* what) {
  const dds_entity_t writer =
      open_writer(participant, &lifeline_msg_AgentStatus_desc, "lifeline/agent_status");
  static char other[] = "other";
  lifeline_msg_AgentStatus status = {.envelope = envelope(), .agent_id = other};
  if (strcmp(what, "bad_boolean") == 0) status.duplicate_id_heard = 2;
  if (strcmp(what, "wide_enumerator") == 0) status.role = 65536;
  const dds_return_t result = dds_write(writer, &status);
  if (result < 0) return result;
  status = (lifeline_msg_AgentStatus){.envelope = envelope(), .agent_id = name};
  return dds_write(writer, &status);
}

int main(int argc, char** argv) {
  if (argc != 7 || strcmp(argv[1], "--domain") != 0 || strcmp(argv[3], "--what") != 0 ||
      strcmp(argv[5], "--seconds") != 0) {
    fputs("usage: lifeline-cyclone-stranger --domain N --what KIND --seconds S\n", stderr);
    return 2;
  }
  setenv("CYCLONEDDS_URI", kLoopbackOnly, 0);
  const dds_entity_t participant =
      dds_create_participant((uint32_t)strtoul(argv[2], NULL, 10), NULL, NULL);
  const dds_return_t tiles = write_tiles(participant, argv[4]);
  const dds_return_t statuses = write_statuses(participant, argv[4]);
  if (participant < 0 || tiles < 0 || statuses < 0) {
    fprintf(stderr, "lifeline-cyclone-stranger: %s\n",
            dds_strretcode(-(participant < 0 ? participant : tiles < 0 ? tiles : statuses)));
    return 1;
  }
  dds_sleepfor((dds_duration_t)(strtod(argv[6], NULL) * 1e9));
  dds_delete(participant);
  return 0;
}
