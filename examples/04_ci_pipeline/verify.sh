#!/bin/sh
# A pipeline step: fails (exit 1) where the table in use has drifted from its law by more than
# allowed, and leaves a JUnit file for the pipeline to show. Needs no job file.
# Usage: verify.sh RESULTS VALIDATION_DATA LAW MAX_DRIFT_MPA
set -eu
results=$1 data=$2 law=$3 allowed=$4
exec "${FRICTAB:-frictab}" verify \
  --table "$results/tables/$law.h5" \
  --model "$results/models/$law.json" \
  --data "$data" \
  --max-drift-MPa "$allowed" \
  --junit "$results/junit.xml"
