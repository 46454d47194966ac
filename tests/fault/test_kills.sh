#!/bin/bash
# Some rounds of script/kill-study: kill -9 at random moments, going on with other ranks and threads, the same bits.
exec "$PROJECT_ROOT/script/kill-study" 5
