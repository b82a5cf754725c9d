// The page: wires what it hears to what it shows.
import { Actions } from "./actions";
import { Alarms } from "./alarms";
import { byId, button, element, setAttribute } from "./dom";
import { showFacts } from "./facts";
import { listenToKeys, listenToPointers } from "./input";
import { Link } from "./link";
import { LinksPanel } from "./links_panel";
import { MapView } from "./map_view";
import { drawPair } from "./pair_picture";
import { orderButton } from "./orders";
import { agentOf, FindsPanel, MergesPanel, TeamPanel } from "./panels";
import { State } from "./state";
import { currentTheme, setTheme, THEMES } from "./theme";
import { TileMaps } from "./tiles";
import { TimelineBar } from "./timeline_bar";
import { currentLanguage, say, setLanguage, type Word } from "./words";

const state = new State();
const maps = new TileMaps();
const link = new Link();
const view = new MapView(byId("map"), state, maps);
const actions = new Actions(state, link, view);

const TABS = ["team", "finds", "merges", "links", "log"] as const;
const panels = new Map(TABS.map((name) => [name, element("div", { class: "items" })]));
byId("panels").append(...[...panels].map(([name, items]) =>
  element("div", { id: `panel-${name}`, role: "tabpanel", class: "panel", "aria-labelledby": `tab-${name}`, tabindex: -1 },
    element("h2", { class: "title", "data-word": name }), items)));
const lists = [
  new TeamPanel(state, actions, panels.get("team")!),
  new FindsPanel(state, actions, panels.get("finds")!),
  new MergesPanel(state, actions, panels.get("merges")!),
  new LinksPanel(state, panels.get("links")!),
  new Alarms(state, actions, panels.get("log")!),
  new TimelineBar(state, actions, byId("timeline")),
];

let tab: (typeof TABS)[number] = "team";
let members: string | null = null, lastTileMs = 0, liveMap = "";

function chooseTab(name: (typeof TABS)[number]): void {
  tab = name;
  for (const each of TABS) {
    setAttribute(byId(`tab-${each}`), "aria-selected", String(each === name));
    byId(`tab-${each}`).tabIndex = each === name ? 0 : -1;
    byId(`panel-${each}`).dataset["chosen"] = each === name ? "yes" : "no";
  }
}

function buildTabs(): void {
  const move = (event: Event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[(event as KeyboardEvent).key];
    if (!by) return;
    event.stopPropagation();
    const next = TABS[(TABS.indexOf(tab) + by + TABS.length) % TABS.length]!;
    chooseTab(next);
    byId(`tab-${next}`).focus();
  };
  byId("tabs").replaceChildren(...TABS.map((name) =>
    button(say(name), () => chooseTab(name), { id: `tab-${name}`, role: "tab", "aria-controls": `panel-${name}`, keydown: move })));
  chooseTab(tab);
}

function nextTheme(): void {
  setTheme(THEMES[(THEMES.indexOf(currentTheme()) + 1) % THEMES.length]!);
  maps.repaint();
  view.redraw();
  label();
}
function nextLanguage(): void {
  setLanguage(currentLanguage() === "en" ? "de" : "en");
  label();
}
function showHelp(): void {
  const help = byId("help") as HTMLDialogElement;
  help.replaceChildren(
    element("h2", {}, say("keysTitle")),
    element("ul", {}, ...say("keys").split("|").map((line) => element("li", {}, line))),
    button(say("close"), () => help.close(), { autofocus: true }));
  setAttribute(help, "aria-label", say("keysTitle"));
  if (!help.open) help.showModal();
}

/// Everything that is words.
function label(): void {
  document.documentElement.lang = currentLanguage();
  for (const node of document.querySelectorAll<HTMLElement>("[data-word]")) node.textContent = say(node.dataset["word"] as Word);
  for (const node of document.querySelectorAll<HTMLElement>("[data-label]")) node.setAttribute("aria-label", say(node.dataset["label"] as Word));
  const icon = (sign: string, word: Word, act: () => void) => button(sign, act, { "aria-label": say(word), title: say(word) });
  const maps = element("select", { id: "map-choice", "aria-label": say("shownMap"), change: (event) => actions.showMap((event.target as HTMLSelectElement).value) });
  byId("map-tools").replaceChildren(
    icon("+", "zoomIn", () => view.camera.zoom(1.4)), icon("−", "zoomOut", () => view.camera.zoom(1 / 1.4)),
    icon("⟲", "turnLeft", () => view.camera.turn(Math.PI / 12)), icon("⟳", "turnRight", () => view.camera.turn(-Math.PI / 12)),
    button(say("fit"), () => view.fit()), button(say("measure"), () => actions.startMeasure()),
    button(say("route"), () => actions.showRoute()), button(say("setExit"), () => actions.startExit()),
    button(say("searchHelp"), () => actions.showSearch(), { id: "search-help" }), button(say("whoSearched"), () => actions.showWho(), { id: "who-searched" }), maps);
  byId("settings").replaceChildren(
    button(say("lookBack"), () => actions.time.lookBackOrLive(), { id: "look-back" }),
    button(`${say("theme")}: ${say(currentTheme())}`, nextTheme, { id: "theme" }),
    button(currentLanguage() === "en" ? "Deutsch" : "English", nextLanguage, { lang: currentLanguage() === "en" ? "de" : "en" }),
    button(`? ${say("help")}`, showHelp));
  buildTabs();
  showOrders();
  for (const list of lists) list.relabel();
  showAll();
}

function showOrders(): void {
  const may = state.mayOrder();
  const key = `${may} ${currentLanguage()}`;
  if (byId("orders").dataset["key"] === key) return;
  byId("orders").dataset["key"] = key;
  byId("orders").replaceChildren(...(may ? [orderButton(actions, "evacuate", 1), orderButton(actions, "rollCall", 2)] : []));
}

/// No silent jump: who joins or leaves the common map is said.
function noteMembers(): void {
  const now = state.merges?.members ?? [];
  const key = now.join("\n");
  if (key === members) return;
  const before = members ? members.split("\n") : [];
  const isFirst = members === null;
  members = key;
  if (isFirst) return;
  const news = [...now.filter((m) => !before.includes(m)).map((m) => say("joins", agentOf(m))),
    ...before.filter((m) => !now.includes(m)).map((m) => say("leaves", agentOf(m)))];
  actions.announce(say("mapChanged", news.join(", ")));
}

function chooseMap(): void {
  if (!state.fleet) return;
  const known = state.fleet.maps;
  const select = document.querySelector<HTMLSelectElement>("#map-choice");
  if (!state.mapChosen || !known.includes(state.map)) {
    const wanted = known.includes("") ? "" : (known[0] ?? "");
    if (wanted !== state.map) {
      state.map = wanted;
      view.camera.isHeld = false;
    }
  }
  if (!select) return;
  const key = known.join("\n") + currentLanguage();
  if (select.dataset["key"] !== key) {
    select.dataset["key"] = key;
    select.replaceChildren(...known.map((map) => element("option", { value: map }, map === "" ? say("commonMap") : say("ownMap", map))));
  }
  if (document.activeElement !== select || select.value !== state.map) select.value = state.map;
}

function watchedMaps(): string[] {
  const pair = state.selectedPair?.split(" ") ?? [];
  return [...new Set([state.map, ...pair])];
}

function showPair(): void {
  const merge = state.merges?.merges.find((each) => MergesPanel.key(each) === state.selectedPair);
  const canvas = document.querySelector<HTMLCanvasElement>("canvas.pair:not([hidden])");
  if (!merge || !canvas) return;
  const a = maps.get(merge.mapA), b = maps.get(merge.mapB);
  const key = [a.changes, b.changes, merge.xM, merge.yM, merge.yawRad, currentTheme()].join();
  if (canvas.dataset["key"] === key) return;
  canvas.dataset["key"] = key;
  drawPair(canvas, merge, a, b, view.cellM());
}

function showAll(): void {
  chooseMap();
  const watched = watchedMaps();
  maps.keep(watched);
  link.watch(watched);
  showOrders();
  showFacts(state, link, view, lastTileMs);
  for (const list of lists) list.show();
  byId("look-back").hidden = state.timeline !== null;
  showPair();
  setAttribute(byId("search-help"), "aria-pressed", String(state.search.isShown));
  setAttribute(byId("who-searched"), "aria-pressed", String(state.search.isTinted));
}

let due = false;
function soon(): void {
  if (due) return;
  due = true;
  setTimeout(() => {
    due = false;
    showAll();
  }, 100);
}

/// Live is left, or come back to: what was shown of the other time is void.
function changeTime(why: string): void {
  [members, lastTileMs, view.route] = [null, 0, null];
  if (state.isLookingBack()) liveMap = state.map;
  else state.map = liveMap;
  if (!state.timeline) actions.announce(why ? say("liveAgainBecause", why) : say("liveAgain"));
  view.redraw();
  showAll();
}

link.onFrame = (frame) => {
  const { content } = frame;
  if (content.case === "tiles") {
    maps.take(content.value);
    if (content.value.map === state.map && content.value.tiles.length > 0 && !content.value.fromStart) lastTileMs = performance.now();
    return;
  }
  const before = state.alerts, wasPast = state.isLookingBack();
  state.take(frame);
  if (state.isLookingBack() !== wasPast) changeTime(content.case === "live" ? content.value.why : "");
  if (content.case === "poses") actions.showWhatIsWanted();
  if (content.case === "merges") noteMembers();
  if (state.alerts !== before) showAll();
  else if (content.case !== "poses") soon();
};
link.onState = showAll;
actions.changed = () => {
  view.redraw();
  showAll();
};
setTheme(currentTheme());
label();
listenToPointers(view, state, actions);
listenToKeys(view, actions, { theme: nextTheme, language: nextLanguage, help: showHelp });
setInterval(soon, 500);
const frame = () => {
  view.draw();
  requestAnimationFrame(frame);
};
requestAnimationFrame(frame);
link.start();

/// For tests and measurements: what the page holds, as it was decoded.
declare global {
  interface Window {
    lifeline: unknown;
  }
}
window.lifeline = {
  state,
  hash: () => view.map.sha256(),
  expectedHash: () => [...(state.fleet?.commonMapSha256 ?? [])].map((octet) => octet.toString(16).padStart(2, "0")).join(""),
  tiles: () => view.map.tiles.size,
  isComplete: () => view.map.isComplete,
  isShown: () => view.isShown(),
  frames: () => view.frames,
  view,
  actions,
  show: showAll,
};
