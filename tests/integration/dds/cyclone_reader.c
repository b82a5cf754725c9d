/* lifeline-cyclone-reader --domain N --seconds S [--tiles K] [--directives K]
 *
 * Subscribes lifeline/tsd_tile and lifeline/merge_directive with Cyclone DDS, a second DDS
 * implementation, on types built from the same IDL, and prints each sample as one line of
 * JSON: texts as they are, the tile's payload in hexadecimal. Ends after S seconds, or as soon as it
 * has had K tiles and K directives where asked for. Exit status: 0, 1 when Cyclone DDS refuses
 * something, 2 on wrong use.
 *
 * Stays on the loopback interface unless CYCLONEDDS_URI says otherwise. */

#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dds/dds.h"
#include "map.h"
#include "merge.h"

enum { kBatch = 64 };

struct options {
  uint32_t domain;
  double seconds;
  unsigned long tiles, directives; /* 0: no end */
};

/* As config/qos/loopback.xml: unicast on 127.0.0.1, nothing above 1,400 octets. */
static const char kLoopbackOnly[] =
    "<CycloneDDS><Domain id=\"any\"><General>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast>"
    "<MaxMessageSize>1400B</MaxMessageSize><FragmentSize>1300B</FragmentSize></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>47</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

static int wrong_use(void) {
  fputs("usage: lifeline-cyclone-reader --domain N --seconds S [--tiles K] [--directives K]\n",
        stderr);
  return 2;
}

static bool parse(int argc, char** argv, struct options* options) {
  bool has_domain = false;
  *options = (struct options){.domain = 0, .seconds = 10.0, .tiles = 0, .directives = 0};
  for (int i = 1; i + 1 < argc; i += 2) {
    char* end = NULL;
    const double value = strtod(argv[i + 1], &end);
    if (*argv[i + 1] == '\0' || *end != '\0' || value < 0.0 || value > 1e6) return false;
    if (strcmp(argv[i], "--domain") == 0) {
      options->domain = (uint32_t)value;
      has_domain = true;
    } else if (strcmp(argv[i], "--seconds") == 0) {
      options->seconds = value;
    } else if (strcmp(argv[i], "--tiles") == 0) {
      options->tiles = (unsigned long)value;
    } else if (strcmp(argv[i], "--directives") == 0) {
      options->directives = (unsigned long)value;
    } else {
      return false;
    }
  }
  return argc % 2 == 1 && has_domain;
}

static void print_text(const char* name, const char* text) {
  printf("\"%s\":\"", name);
  for (const unsigned char* c = (const unsigned char*)text; *c != '\0'; ++c) {
    if (*c == '"' || *c == '\\') {
      printf("\\%c", *c);
    } else if (*c < 0x20) {
      printf("\\u%04x", *c);
    } else {
      putchar(*c);
    }
  }
  fputs("\",", stdout);
}

static void print_envelope(const lifeline_msg_Envelope* envelope) {
  printf("\"protocol_version\":%" PRIu16 ",", envelope->protocol_version);
  print_text("mission_id", envelope->mission_id);
  print_text("sender_id", envelope->sender_id);
  printf("\"incarnation\":%" PRIu64 ",\"sequence\":%" PRIu64 ",\"sent_at_ns\":%" PRId64
         ",\"signature_octets\":%" PRIu32 ",",
         envelope->incarnation, envelope->sequence_number, envelope->sent_at_ns,
         envelope->signature._length);
}

static void print_tile(const void* sample) {
  const lifeline_msg_TsdTile* tile = sample;
  fputs("{\"topic\":\"tsd_tile\",", stdout);
  print_envelope(&tile->envelope);
  print_text("agent_id", tile->agent_id);
  printf("\"map_id\":%" PRIu32 ",\"floor\":%" PRId16 ",\"tile_x\":%" PRId32 ",\"tile_y\":%" PRId32
         ",\"part\":%d,\"parts\":%d,\"revision\":%" PRIu64 ",\"payload\":\"",
         tile->map_id, tile->floor, tile->tile_x, tile->tile_y, tile->part, tile->parts, tile->revision);
  for (uint32_t i = 0; i < tile->payload._length; ++i) printf("%02x", tile->payload._buffer[i]);
  puts("\"}");
}

static void print_member(const lifeline_msg_DirectiveMember* member) {
  const lifeline_msg_FixedTransform* transform = &member->T_common_map;
  putchar('{');
  print_text("agent_id", member->layer.agent_id);
  printf("\"map_id\":%" PRIu32 ",\"floor\":%" PRId16 ",\"group\":%" PRIu16 ",",
         member->layer.map_id, member->layer.floor, member->group);
  printf("\"cos_q30\":%" PRId32 ",\"sin_q30\":%" PRId32 ",\"x_um\":%" PRId64 ",\"y_um\":%" PRId64
         ",\"covariance\":[",
         transform->cos_q30, transform->sin_q30, transform->x_um, transform->y_um);
  for (int i = 0; i < 6; ++i) printf("%s%.17g", i > 0 ? "," : "", member->covariance[i]);
  printf("],\"quality\":%.9g}", (double)member->quality);
}

static void print_directive(const void* sample) {
  const lifeline_msg_MergeDirective* directive = sample;
  fputs("{\"topic\":\"merge_directive\",", stdout);
  print_envelope(&directive->envelope);
  print_text("directive_mission_id", directive->mission_id);
  printf("\"epoch\":%" PRIu64 ",\"own_weight_permille\":%" PRIu16 ",\"members\":[",
         directive->epoch, directive->own_weight_permille);
  for (uint32_t i = 0; i < directive->members._length; ++i) {
    if (i > 0) putchar(',');
    print_member(&directive->members._buffer[i]);
  }
  puts("]}");
}

/* A reader of the QoS that docs/topics.md lists for both topics; negative on failure. */
static dds_entity_t open_reader(dds_entity_t participant, const dds_topic_descriptor_t* type,
                                const char* name, dds_ownership_kind_t ownership) {
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  if (topic < 0) return topic;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  dds_qset_ownership(qos, ownership);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

/* Prints all that waits at `reader`; how many samples that was. */
static unsigned long drain(dds_entity_t reader, void (*print)(const void*)) {
  void* samples[kBatch] = {NULL};
  dds_sample_info_t infos[kBatch];
  unsigned long printed = 0;
  for (;;) {
    const dds_return_t taken = dds_take(reader, samples, infos, kBatch, kBatch);
    if (taken <= 0) return printed;
    for (dds_return_t i = 0; i < taken; ++i) {
      if (!infos[i].valid_data) continue;
      print(samples[i]);
      ++printed;
    }
    fflush(stdout);
    dds_return_loan(reader, samples, taken);
  }
}

static bool is_done(const struct options* options, unsigned long tiles, unsigned long directives) {
  const bool asked = options->tiles > 0 || options->directives > 0;
  return asked && tiles >= options->tiles && directives >= options->directives;
}

static int run(const struct options* options) {
  const dds_entity_t participant = dds_create_participant(options->domain, NULL, NULL);
  const dds_entity_t tiles = open_reader(participant, &lifeline_msg_TsdTile_desc,
                                         "lifeline/tsd_tile", DDS_OWNERSHIP_SHARED);
  const dds_entity_t directives =
      open_reader(participant, &lifeline_msg_MergeDirective_desc, "lifeline/merge_directive",
                  DDS_OWNERSHIP_EXCLUSIVE);
  if (participant < 0 || tiles < 0 || directives < 0) {
    const dds_entity_t failed = participant < 0 ? participant : tiles < 0 ? tiles : directives;
    fprintf(stderr, "lifeline-cyclone-reader: %s\n", dds_strretcode(-failed));
    return 1;
  }
  unsigned long tiles_had = 0, directives_had = 0;
  const dds_time_t end = dds_time() + (dds_duration_t)(options->seconds * 1e9);
  while (dds_time() < end && !is_done(options, tiles_had, directives_had)) {
    tiles_had += drain(tiles, print_tile);
    directives_had += drain(directives, print_directive);
    dds_sleepfor(DDS_MSECS(20));
  }
  dds_delete(participant);
  return 0;
}

int main(int argc, char** argv) {
  struct options options;
  if (!parse(argc, argv, &options)) return wrong_use();
  setenv("CYCLONEDDS_URI", kLoopbackOnly, 0);
  return run(&options);
}
