// The report first, then what makes it live.
start();
startLive();
