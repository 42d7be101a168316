// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/base/line_writer.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace plumescout::server {
namespace {

// A pipe that poll() calls writable takes this much without blocking.
constexpr std::size_t kChunkBytes = PIPE_BUF;
constexpr int kPollPeriod_ms = 50;

}  // namespace

LineWriter::LineWriter(int fd, std::size_t max_queued_bytes, DropNotice drop_notice)
    : fd_(fd),
      max_queued_bytes_(max_queued_bytes),
      drop_notice_(std::move(drop_notice)),
      thread_([this] { Run(); }) {}

LineWriter::~LineWriter() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void LineWriter::Push(std::string line) {
  absl::MutexLock lock(&mutex_);
  if (queued_bytes_ + line.size() > max_queued_bytes_) {
    ++counts_.dropped;
    ++unreported_drops_;
    return;
  }
  ReportDrops();
  queued_bytes_ += line.size();
  lines_.push_back(std::move(line));
}

void LineWriter::ReportDrops() {
  if (unreported_drops_ == 0) return;
  lines_.push_back(drop_notice_(std::exchange(unreported_drops_, 0)));
  queued_bytes_ += lines_.back().size();
}

bool LineWriter::Flush(absl::Duration patience) {
  absl::MutexLock lock(&mutex_);
  return mutex_.AwaitWithTimeout(absl::Condition(this, &LineWriter::IsIdle), patience);
}

LineCounts LineWriter::counts() const {
  absl::MutexLock lock(&mutex_);
  return counts_;
}

void LineWriter::Run() {
  while (true) {
    int lines = 0;
    const std::string chunk = TakeChunk(lines);
    if (chunk.empty()) return;
    const bool written = Write(chunk);
    absl::MutexLock lock(&mutex_);
    writing_ = false;
    (written ? counts_.written : counts_.dropped) += lines;
  }
}

std::string LineWriter::TakeChunk(int& lines) {
  absl::MutexLock lock(&mutex_);
  mutex_.Await(absl::Condition(this, &LineWriter::HasWork));
  if (lines_.empty()) ReportDrops();
  std::string chunk;
  while (!lines_.empty() &&
         (chunk.empty() || chunk.size() + lines_.front().size() <= kChunkBytes)) {
    queued_bytes_ -= lines_.front().size();
    chunk += lines_.front();
    lines_.pop_front();
    ++lines;
  }
  writing_ = !chunk.empty();
  return chunk;
}

bool LineWriter::Write(const std::string& chunk) {
  std::size_t done = 0;
  while (done < chunk.size()) {
    if (!MayWrite()) return false;
    const ssize_t count =
        write(fd_, chunk.data() + done, std::min(chunk.size() - done, kChunkBytes));
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR && errno != EAGAIN) {
      return false;  // nobody reads any more
    }
  }
  return true;
}

bool LineWriter::MayWrite() {
  while (true) {
    const bool stopping = IsStopping();
    pollfd wanted{fd_, POLLOUT, 0};
    // An error is for write() to tell.
    if (poll(&wanted, 1, stopping ? 0 : kPollPeriod_ms) > 0) return true;
    if (stopping) return false;
  }
}

}  // namespace plumescout::server
