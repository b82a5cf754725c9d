// The line above the map: is this live, how long, how much, how old, and who shares it.
import { byId, element, setText } from "./dom";
import type { Link } from "./link";
import type { MapView } from "./map_view";
import type { State } from "./state";
import { clock, decimals, duration, say, type Word } from "./words";

function fact(word: Word, value: string, urgent = false): HTMLElement {
  return element("div", urgent ? { "data-urgent": "yes" } : {}, element("dt", {}, say(word)), element("dd", {}, value));
}

export function showFacts(state: State, link: Link, view: MapView, lastTileMs: number): void {
  const helmets = state.helmets();
  const silentS = (performance.now() - link.heardAtMs) / 1000;
  const connection = link.isOpen && state.timeline ? say(state.isLookingBack() ? "notLive" : "recording") : link.isOpen ? (state.hello?.mayCommand ? say("live") : `${say("live")}, ${say("lookOnly")}`)
    : !state.hello ? say(link.attempts > 2 ? "refused" : "joining") : say("lost", duration(silentS));
  const holders = helmets.filter(({ agent }) => agent.holdsSameMap).length;
  const cellM = view.cellM();
  const area = state.hello?.areaM2 ?? 0;
  const seenM2 = view.map.knownCells() * cellM * cellM;
  const searched = area > 0 ? `${decimals(Math.min(100, (100 * seenM2) / area), 0)} %, ${decimals(seenM2, 0)} m²` : "–";
  const ageS = state.map === "" && state.fleet?.commonMapSha256.length ? state.now() - state.fleet.commonMapChangedAtS
    : lastTileMs === 0 ? null : (performance.now() - lastTileMs) / 1000;
  const isIdle = !state.timeline && state.fleet?.leads === false;
  const map = isIdle ? say("doesNotLead")
    : state.fleet?.commonMapSha256.length ? say("sharedBy", holders, helmets.length) : say("noCommon");
  const facts = byId("facts");
  facts.replaceChildren(
    element("div", { id: "connection", "data-urgent": link.isOpen && !state.isLookingBack() ? undefined : "yes" }, element("dt", {}, "●"), element("dd", {}, connection)),
    fact("clock", clock(state.now())), fact("searched", searched),
    fact("mapAge", ageS === null ? "–" : duration(ageS)), fact("shared", map, isIdle));
  setText(byId("mission"), state.hello?.missionId ?? "Lifeline");
}
