// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Writes the inputs that fuzzing begins with, a folder a target: make_corpus FOLDER.

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/mission/mission.h"
#include "core/types/event.h"
#include "formats/file_io.h"
#include "formats/journal/event_codec.h"
#include "formats/mcap/mcap_encoder.h"
#include "formats/mcap/mcap_journal.h"
#include "formats/zlib_codec.h"
#include "formats/zstd_codec.h"
#include "lab/formats/scene_json.h"
#include "server/missions/standing_record.h"
#include "server/web/grpc_web.h"
#include "tests/fuzz/request_steps.h"
#include "tests/fuzz/small_mission.h"
#include "tests/fuzz/small_service.h"
#include "tests/support/box_room.h"
#include "tests/support/gaden_files.h"
#include "tests/support/lz4_frame.h"

namespace plumescout::fuzz {
namespace {

class Corpus {
 public:
  explicit Corpus(const std::string& folder) : folder_(folder) {}

  void Add(const std::string& target, const std::string& name, const std::string& bytes) {
    const std::string folder = absl::StrCat(folder_, "/", target);
    status_.Update(MakeFolder(folder));
    status_.Update(WriteFile(absl::StrCat(folder, "/", name), bytes));
  }
  // The bytes of a file, with `prefix` before them.
  void AddFile(const std::string& target, const std::string& name, const std::string& path,
               const std::string& prefix = "") {
    constexpr std::uint64_t kMax_bytes = 1 << 16;
    const auto bytes = ReadFile(path, kMax_bytes);
    status_.Update(bytes.status());
    if (bytes.ok()) Add(target, name, prefix + *bytes);
  }
  const absl::Status& status() const { return status_; }

 private:
  const std::string folder_;
  absl::Status status_;
};

void AddRequests(Corpus& corpus) {
  corpus.Add("requests", "mission", SerializeSteps(GoodSteps()));
  for (const char* strategy : {"xit_gff", "mit", "ipp_reward", "lhr", "sweep"}) {
    Steps steps = GoodSteps();
    static_cast<v1::CreateMissionRequest&>(*steps[0].request)
        .mutable_options()
        ->mutable_planning()
        ->set_strategy(strategy);
    corpus.Add("requests", strategy, SerializeSteps(steps));
  }
  for (std::size_t kind = 0; kind < HandledRequests().size(); ++kind) {
    Steps steps;
    steps.push_back(GoodStep(kind));
    corpus.Add("requests", HandledRequests()[kind].prototype->GetDescriptor()->name(),
               SerializeSteps(steps));
  }
}

std::string WithLength(const std::string& body) {
  return absl::StrCat(std::string(1, static_cast<char>(body.size() % 256)),
                      std::string(1, static_cast<char>(body.size() / 256)), body);
}

// A short mission: a robot that sees a room and reads gas in it, and goes.
std::vector<EventBody> ShortMission() {
  const Pose2 pose{1.0, 1.5, 0.0};
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  Scan scan = support::ScanInBox(pose, 6.0, 4.0);
  return {RobotRegistered{"r1", 0.2, 1},
          ObservationReceived{"r1", {1, kSecond_ns, pose, scan}},
          ObservationReceived{"r1", {2, 2 * kSecond_ns, pose, GasReading{5.0, 0.0}}},
          ObservationReceived{"r1", {3, 3 * kSecond_ns, pose, SequenceGap{3, 4}}},
          PosteriorRefreshed{3 * kSecond_ns},
          EpochBegun{3 * kSecond_ns},
          EpochAdopted{},
          RobotRemoved{"r1"}};
}

void AddSnapshots(Corpus& corpus) {
  Mission mission(SmallMission());
  for (const EventBody& body : ShortMission()) {
    mission.Apply(body).status().IgnoreError();  // a snapshot is of any state
    const auto state = mission.SaveState();
    if (state.ok()) corpus.Add("snapshot", absl::StrCat("revision-", mission.revision()), *state);
  }
  server::StandingRecord standing;
  standing.released_leases = {{"r1", 7}};
  corpus.Add("snapshot", "standing", server::EncodeStanding(standing));
}

void AddStrangers(Corpus& corpus) {
  corpus.Add("access", "subject", "CN=scout,OU=robot,O=acme");
  corpus.Add("access", "token",
             absl::StrCat(std::string(64, 'a'), " scout robot acme 2030-01-01T00:00:00Z"));
  const std::string frame = server::MessageFrame("message");
  corpus.Add("web", "call",
             absl::StrCat("POST /plumescout.v1.MapService/GetMap HTTP/1.1\r\nHost: a\r\n"
                          "Content-Type: ",
                          server::kGrpcWebType, "\r\ngrpc-timeout: 5S\r\nContent-Length: ",
                          frame.size(), "\r\n\r\n", frame));
  corpus.Add("web", "page", "GET /index.html?x=1 HTTP/1.1\r\nHost: a\r\n\r\n");
}

void AddRecordings(Corpus& corpus) {
  std::string all;
  std::int64_t number = 0;
  for (const EventBody& body : ShortMission()) {
    const std::string event = EncodeEvent({++number, body});
    corpus.Add("recording", absl::StrCat("record-", number), event);
    corpus.Add("recording", absl::StrCat("event-", number), WithLength(event));
    all += WithLength(event);
  }
  corpus.Add("recording", "mission", all);
  for (const char* version : {"version_3", "version_4", "version_5"}) {
    corpus.AddFile("recording", version,
                   absl::StrCat("tests/formats/journal/golden/", version, ".events"));
  }
}

void AddMcap(Corpus& corpus) {
  for (const McapCompression compression : {McapCompression::kNone, McapCompression::kZstd}) {
    McapEncoder encoder("fuzz", compression, 100);
    const std::uint16_t schema = encoder.AddSchema("a.B", "protobuf", "schema");
    const std::uint16_t other = encoder.AddChannel("/other", "protobuf", schema);
    const std::uint16_t journal = encoder.AddChannel(kMcapJournalTopic, kMcapJournalEncoding, 0);
    absl::Status status = encoder.Add({journal, 0, 1, 1, EncodeStart({.code_version = "fuzz"})});
    status.Update(encoder.Add({journal, 1, 2, 2, EncodeEvent({1, RobotRemoved{"r1"}})}));
    status.Update(encoder.Add({other, 1, 3, 3, "message"}));
    status.Update(encoder.Finish());
    const bool packed = compression == McapCompression::kZstd;
    if (status.ok()) corpus.Add("mcap", packed ? "zstd" : "plain", encoder.Take());
  }
  const std::string records =
      EncodeMcap(McapChannel{1, 0, "/a", "text"}) + EncodeMcap(McapMessage{1, 2, 3, 4, "m"});
  corpus.Add("mcap", "lz4",
             absl::StrCat(
                 kMcapMagic, McapFields().Text("").Text("").Record(McapOp::kHeader),
                 EncodeMcap(McapChunk{3, 3, records.size(), 0, "lz4", support::PackLz4(records)})));
  corpus.Add("mcap", "records", records);
}

void AddMaps(Corpus& corpus) {
  const std::string yaml =
      "image: map.pgm\nresolution: 0.1\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n";
  const std::string pgm = "P5\n# hall\n3 2\n255\n\xFE\xFE\xFE" + std::string(3, '\0');
  corpus.Add("map_server", "map", yaml + std::string(1, '\0') + pgm);
  corpus.Add("map_server", "pgm", pgm);
  const std::string cells("\x03\x02\x00\x01\x02\x02\x01\x00", 8);
  corpus.Add("packed", "cells", cells);
  corpus.Add("packed", "zlib", CompressZlib(cells));
  const auto zstd = CompressZstd(std::string(4096, 'a'));
  if (zstd.ok()) corpus.Add("packed", "zstd", *zstd);
  corpus.Add("packed", "lz4", support::PackLz4(std::string(4096, 'a')));
}

std::string NpyHeader(const std::string& type, const std::string& shape, std::size_t values,
                      std::size_t value_bytes) {
  std::string header =
      absl::StrCat("{'descr': '", type, "', 'fortran_order': False, 'shape': ", shape, ", }");
  header.resize(117, ' ');
  header += '\n';
  return absl::StrCat("\x93NUMPY", std::string("\x01\x00\x76\x00", 4), header,
                      std::string(values * value_bytes, '\0'));
}

void AddArrays(Corpus& corpus) {
  corpus.Add("npy", "f4", NpyHeader("<f4", "(2, 3)", 6, 4));
  corpus.Add("npy", "f8", NpyHeader("<f8", "(2,)", 2, 8));
  corpus.Add("npy", "scalar", NpyHeader("<f4", "()", 1, 4));
}

void AddTexts(Corpus& corpus) {
  corpus.AddFile("config", "default", "deploy/config/plumescout.yaml");
  corpus.Add("config", "few",
             "listen: 127.0.0.1:0\nlimits: {max_missions: 2}\nmission:\n"
             "  keep_out:\n    - vertices: [{x_m: 1}, {y_m: 1}, {}]\n");
  corpus.AddFile("scene", "layout", "lab/scenes/industrial_16x20.yaml", "1");
  lab::Scene scene;
  scene.name = "hall";
  scene.occupancy = Grid<CellState>(GridGeometry{0.0, 0.0, 0.5, 4, 3}, CellState::kFree);
  scene.series.frames = 2;
  scene.sources.push_back({.id = 1, .x_m = 1.0, .y_m = 1.0, .z_m = 0.5, .rate_ppm_per_s = 10.0});
  scene.start_pose = {0.5, 0.5, 0.0};
  corpus.Add("scene", "json",
             "0" + lab::FormatSceneJson(scene, {"conc_ts.u16.zst", "wind_uv.npy"}));
}

void AddGaden(Corpus& corpus) {
  const lab::GadenEnvironment room = support::GadenRoom();
  lab::GadenFrame frame = support::SampleFrame();
  corpus.Add("gaden", "environment", std::string(1, '\0') + support::EnvironmentText(room));
  corpus.Add("gaden", "frame-2", "\1" + support::FrameBytes2(frame));
  corpus.Add("gaden", "frame-3", "\1" + support::FrameBytes3(frame));
  frame.concentrations_ppm = {1.0F, 2.0F};
  corpus.Add("gaden", "frame-3-concentrations", "\1" + support::FrameBytes3(frame));
  lab::GadenEnvironment small;  // that of gaden_fuzz.cc
  small.cells = {2, 2, 1};
  corpus.Add("gaden", "wind", "\2" + support::WindBytes3(small, 0.5F, -0.5F));
}

int Run(const std::string& folder) {
  Corpus corpus(folder);
  AddRequests(corpus);
  AddRecordings(corpus);
  AddSnapshots(corpus);
  AddStrangers(corpus);
  AddMaps(corpus);
  AddMcap(corpus);
  AddArrays(corpus);
  AddTexts(corpus);
  AddGaden(corpus);
  if (corpus.status().ok()) return 0;
  std::fprintf(stderr, "%s\n", corpus.status().ToString().c_str());
  return 1;
}

}  // namespace
}  // namespace plumescout::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "make_corpus FOLDER\n");
    return 2;
  }
  return plumescout::fuzz::Run(argv[1]);
}
