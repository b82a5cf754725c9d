// Pointer and keyboard on the map, and keys for everything.
import type { Actions } from "./actions";
import { byId } from "./dom";
import type { MapView } from "./map_view";
import type { State } from "./state";

const STEP_PX = 60;
const TURN_RAD = Math.PI / 12;

export interface Keys {
  theme(): void;
  language(): void;
  help(): void;
}

function helmetAt(view: MapView, state: State, px: number, py: number): string | null {
  for (const { agent, pose } of state.helmets()) {
    if (!pose || pose.map !== state.map) continue;
    const [x, y] = view.camera.toScreen(pose.xM, pose.yM);
    if (Math.hypot(x - px, y - py) < 22) return agent.agentId;
  }
  return null;
}

export function listenToPointers(view: MapView, state: State, actions: Actions): void {
  const box = byId("map");
  const fingers = new Map<number, { x: number; y: number }>();
  let moved = 0;
  box.addEventListener("pointerdown", (event) => {
    box.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    moved = 0;
  });
  box.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.offsetX, y: event.offsetY };
    const others = [...fingers].filter(([id]) => id !== event.pointerId).map(([, p]) => p);
    if (others.length === 0) {
      moved += Math.hypot(now.x - before.x, now.y - before.y);
      if (moved > 4) view.camera.pan(before.x - now.x, before.y - now.y);
    } else {
      const other = others[0]!;
      const d0 = Math.hypot(before.x - other.x, before.y - other.y), d1 = Math.hypot(now.x - other.x, now.y - other.y);
      const a0 = Math.atan2(before.y - other.y, before.x - other.x), a1 = Math.atan2(now.y - other.y, now.x - other.x);
      if (d0 > 10) view.camera.zoom(d1 / d0, other.x, other.y);
      view.camera.turn(-(a1 - a0));
      moved = 99;
    }
    if (moved > 4) fingers.set(event.pointerId, now);
  });
  const up = (event: PointerEvent) => {
    if (fingers.delete(event.pointerId) && event.type === "pointerup" && moved <= 4) {
      if (!actions.choose(event.offsetX, event.offsetY)) actions.select(helmetAt(view, state, event.offsetX, event.offsetY));
    }
  };
  box.addEventListener("pointerup", up);
  box.addEventListener("pointercancel", up);
  box.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.camera.zoom(Math.exp(-event.deltaY / 500), event.offsetX, event.offsetY);
  }, { passive: false });
}

export function listenToKeys(view: MapView, actions: Actions, keys: Keys): void {
  const map: Record<string, () => void> = {
    ArrowLeft: () => view.camera.pan(-STEP_PX, 0),
    ArrowRight: () => view.camera.pan(STEP_PX, 0),
    ArrowUp: () => view.camera.pan(0, -STEP_PX),
    ArrowDown: () => view.camera.pan(0, STEP_PX),
    Enter: () => actions.choose(view.camera.width / 2, view.camera.height / 2),
  };
  const everywhere: Record<string, () => void> = {
    "+": () => view.camera.zoom(1.25),
    "=": () => view.camera.zoom(1.25),
    "-": () => view.camera.zoom(0.8),
    q: () => view.camera.turn(TURN_RAD),
    e: () => view.camera.turn(-TURN_RAD),
    f: () => view.fit(),
    m: () => actions.startMeasure(),
    x: () => actions.startExit(),
    r: () => actions.showRoute(),
    s: () => actions.showSearch(),
    w: () => actions.showWho(),
    b: () => actions.time.lookBackOrLive(),
    p: () => actions.time.playOrPause(),
    ",": () => actions.time.skip(-10),
    ".": () => actions.time.skip(10),
    a: () => actions.acknowledgeFirst(),
    c: () => actions.showMap(""),
    t: keys.theme,
    l: keys.language,
    "?": keys.help,
    Escape: () => actions.leaveOff(),
  };
  for (let n = 1; n <= 9; n++) everywhere[String(n)] = () => actions.selectNumber(n);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const target = event.target as HTMLElement;
    if (target.closest("input, select, textarea, dialog")) return;
    const act = (target.id === "map" ? map[event.key] : undefined) ?? everywhere[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}
