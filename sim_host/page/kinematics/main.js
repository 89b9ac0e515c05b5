import "../shared/theme.css";
import "./style.css";
import { pageData } from "../shared/data.js";
import { addCurves } from "./curves.js";
import { addMachinePanel } from "./panel.js";

const data = pageData();
document.getElementById("summary").textContent = `${data.summary}. A click on a curve goes to its time.`;
const { player, trajectory } = addMachinePanel(document.getElementById("machine"), data);
addCurves(document.getElementById("charts"), data, trajectory, player);
player.seek(player.start);
