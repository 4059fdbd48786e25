// Pictures from the server that the page came from; whatever ends that, it is tried again, and what is no picture is left alone.
const SCHEMA = "scorebreath.picture/1", SILENT = -80;

function understood(text) {
  let told;
  try { told = JSON.parse(text); } catch { return null; }
  if (!told || told.schema !== SCHEMA || typeof told.body !== "string" || !Number.isFinite(told.unix) || !Number.isFinite(told.time)) return null;
  const channels = Object(told.channels), pose = {};
  for (const name of CHANNELS) pose[name] = Number.isFinite(channels[name]) ? channels[name] : name.endsWith("_level") ? SILENT : 0;
  const {text: saying, word} = Object(told.said), places = Array.isArray(word) && word.length === 2 && word.every(Number.isInteger);
  const said = typeof saying === "string" ? {text: saying, word: places ? word : null} : null;
  return {body: told.body, name: String(told.name ?? told.body), time: told.time, unix: told.unix, pose, said};
}

function connect(onPicture, onState) {
  const FIRST = .25, LONGEST = 2, MORE = 1.5;
  const body = new URLSearchParams(location.search).get("body"), address = new URL("/pictures", location.href);
  address.protocol = address.protocol.replace("http", "ws");
  if (body) address.searchParams.set("body", body);
  let wait = FIRST;
  function open() {
    const socket = new WebSocket(address);
    socket.onopen = () => onState("waiting");
    socket.onmessage = ({data}) => {
      const picture = understood(data);
      if (!picture) return;
      wait = FIRST;
      onPicture(picture);
    };
    socket.onclose = () => {
      onState("lost");
      setTimeout(open, wait * 1000);
      wait = Math.min(LONGEST, wait * MORE);
    };
  }
  onState("connecting");
  open();
}
