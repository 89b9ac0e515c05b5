import { pageData } from "../shared/data.js"; document.title = pageData().command;
