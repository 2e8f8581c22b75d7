#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The stillpoint authors
# SPDX-License-Identifier: MIT

# ros1_node.sh NODE CLIENT SEQUENCE FRAMES [HZ]: a roscore on a port of its own, the node, and the client, which sends
# frames and compares the answers; with HZ it measures latency instead, without movers. Wrong parameters end the node with
# a sentence, and missing topics are named. All processes end with this script, and it ends: whatever ROS waits for has a
# limit here, since its programs wait for a master without one.
set -euo pipefail
node=$1 client=$2 sequence=$3 frames=$4 rate=${5:-}
folder=$(mktemp -d)
pids=()
finish() {
  local status=$? pid
  for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null || true; done
  for pid in "${pids[@]}"; do
    timeout 20 tail --pid="$pid" -f /dev/null || { echo "killed: process $pid did not end"; kill -9 "$pid" || true; }
    wait "$pid" 2> /dev/null || true
  done
  [[ $status == 0 ]] || tail -n 20 "$folder"/*.log
  rm -rf "$folder"
}
trap finish EXIT

# wait_for SECONDS COMMAND...: until it succeeds.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@" > /dev/null 2>&1; do
    ((SECONDS < end)) || { echo "not within the time: $*"; return 1; }
    sleep 0.1
  done
}

port=$((20000 + $$ % 20000))
export ROS_MASTER_URI=http://127.0.0.1:$port ROS_IP=127.0.0.1 ROS_HOME=$folder ROS_LOG_DIR=$folder/ros
unset ROS_HOSTNAME
roscore -p "$port" < /dev/null > "$folder/roscore.log" 2>&1 &
pids+=($!)
wait_for 30 bash -c "exec 3<> /dev/tcp/127.0.0.1/$port"

# fails_with SENTENCE ARGUMENT...: the node ends with status 2 and says so.
fails_with() {
  local sentence=$1 status=0
  shift
  timeout 20 "$node" "$@" > "$folder/wrong.log" 2>&1 || status=$?
  [[ $status == 2 ]] && grep -qF "$sentence" "$folder/wrong.log" || { echo "expected: $sentence"; return 1; }
}
fails_with 'parameter gate.false_positive_rate is 5, expected a number from 0.000001 to 0.5' __name:=wrong _gate/false_positive_rate:=5
fails_with "parameter gate.false_positive_rate is 'high', expected a number" __name:=typed _gate/false_positive_rate:=high
fails_with "parameter features is '1000.5', expected a whole number" __name:=fraction _features:=1000.5
fails_with "parameter follow_movers is 'often', expected true or false" __name:=typed _follow_movers:=often
fails_with 'parameter margin is unknown' __name:=misspelled _margin:=5
fails_with 'It stays on the parameter server: rosparam delete /misspelled/margin' __name:=misspelled
fails_with "parameter depth_noise.model is 'lidar', expected kinect or stereo or tof" __name:=other _depth_noise/model:=lidar

follow_movers=true
[[ -z $rate ]] || follow_movers=false
"$node" __name:=stillpoint _depth_units_per_metre:=5000 _follow_movers:=$follow_movers < /dev/null > "$folder/node.log" 2>&1 &
pids+=($!)
for missing in 'no image on /image yet' 'no depth on /depth yet' 'no camera_info on /camera_info yet'; do
  wait_for 20 grep -qF "$missing" "$folder/node.log"
done
limit=$((60 + frames))
timeout -k 5 "$limit" "$client" "$sequence" "$frames" ${rate:+"$rate"} < /dev/null || {
  status=$?
  [[ $status != 124 && $status != 137 ]] || echo "the client did not end within $limit s"
  exit "$status"
}
